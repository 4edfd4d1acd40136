// The files that lights refer to, photometric profiles and pictures: each read once, when it is first asked
// for, within the scene's folder. What cannot be read is an error each time it is asked for.
#pragma once

#include "renderer/document/ies_profile.h"
#include "renderer/document/scene.h"

#include <map>
#include <mutex>
#include <span>

namespace kilolux {

enum class Pictures { Read, LeaveOut };

// Shared by all copies of a document, on all threads.
class SceneFiles {
  public:
    explicit SceneFiles(std::filesystem::path folder, Pictures pictures = Pictures::Read)
        : folder_(std::move(folder)), pictures_(pictures) {}

    // `uri` is relative to the folder, which it cannot leave; a data URI; or '#/...', something of the
    // scene's own file that keep() was given. An empty one is nothing: null. Errors name the URI and what was
    // expected.
    Result<std::shared_ptr<const IesProfile>> profile(const std::string& uri);
    Result<std::shared_ptr<const Image>> image(const std::string& uri); // null where pictures are left out

    // A picture from its bytes, within the room for all pictures of lights.
    Result<std::shared_ptr<const Image>> decode(std::span<const std::uint8_t> bytes, const std::string& name);

    // What the scene's own file holds, and whether that has been told already.
    void keep(const std::string& uri, Result<std::shared_ptr<const IesProfile>> profile);
    void keep(const std::string& uri, Result<std::shared_ptr<const Image>> image);

    bool knows(const std::string& uri) const;

    std::filesystem::path folder() const;
    void moveTo(std::filesystem::path folder); // what has been read stays
    // A file of the folder has changed, or is there now.
    void forget(const std::string& uri);

  private:
    Result<std::shared_ptr<const IesProfile>> readProfile(const std::string& uri) const;
    Result<std::shared_ptr<const Image>> readImage(const std::string& uri);
    Result<std::shared_ptr<const Image>> decodeLocked(std::span<const std::uint8_t> bytes,
                                                      const std::string& name);

    mutable std::mutex mutex_;
    std::filesystem::path folder_;
    Pictures pictures_;
    std::map<std::string, Result<std::shared_ptr<const IesProfile>>> profiles_;
    std::map<std::string, Result<std::shared_ptr<const Image>>> images_;
    std::uint64_t fileBytes_ = 0, decodedBytes_ = 0; // of pictures so far
};

// Fills in what the URIs of a definition, or of the dome, name. The errors of those that cannot be read, with
// the property before each: "iesProfile: 'a.ies': ...".
std::vector<Error> loadFiles(SceneFiles* files, LightDef& def);
std::vector<Error> loadFiles(SceneFiles* files, Dome& dome);

} // namespace kilolux
