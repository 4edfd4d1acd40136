// Saving a document back into the glTF it came from. The file's own JSON text is patched: whatever the edits
// do not touch, known or not, stays byte for byte, and so does the binary part of a .glb.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"

#include <filesystem>
#include <string>

namespace kilolux {

// The file that a document came from. Every save starts from its text as it was opened, so that what is saved
// depends on the document alone and undoing everything gives the first bytes again.
struct SourceFile {
    std::filesystem::path path;
    std::uint64_t diskHash = 0; // of the whole file, as last read or written
    std::uint64_t restHash = 0; // of what is not JSON in a .glb
    std::string jsonText;       // as opened
    bool isBinary = false;      // a .glb
};

Result<SourceFile> readSource(const std::filesystem::path& path);

// The text of a save, and where things stand in it.
struct SavePlan {
    std::string jsonText;
    std::vector<int> nodeIndices;         // per Scene::nodes, in the file's /nodes; -1: not saved
    std::vector<std::string> defPointers; // per Scene::lightDefs, as LightDef::pointer; empty: not saved
};

// `opened` is the document as imported from the source, its ids those of `scene`. Before it is handed out the
// text is read back and compared with the document, so that nothing is saved that would open as something
// else.
Result<SavePlan> planSave(const SourceFile& source, const Scene& opened, const Scene& scene);

// The whole file with another JSON text; `diskBytes` is the file as it is now and gives a .glb its other
// chunks.
Result<std::string> withJsonText(const SourceFile& source, std::string_view diskBytes,
                                 std::string_view jsonText);

// Copies what the JSON of a file refers to by relative URIs to the folder of another file, where it is not
// there yet. An error where something else of that name is.
std::optional<Error> copyResources(const std::filesystem::path& source, std::string_view jsonText,
                                   const std::filesystem::path& target);

} // namespace kilolux
