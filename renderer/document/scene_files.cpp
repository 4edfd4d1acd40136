#include "renderer/document/scene_files.h"

#include "renderer/document/gltf_context.h"
#include "renderer/document/image_import.h"
#include "renderer/document/light_properties.h"

namespace kilolux {

namespace {

// Pictures of all lights together: a free amount, and what their files may hold decoded.
constexpr std::uint64_t kFreeImageBytes = 32ull << 20;
constexpr std::uint64_t kImageTimesFile = 4;
constexpr std::uint64_t kMostProfileBytes = 16ull << 20;

std::string quoted(const std::string& uri) {
    return "'" + gltf::printable(gltf::isDataUri(uri) ? uri.substr(0, 24) : uri) + "'";
}

// Throws gltf::ImportFailure, as the readers of glTF do.
gltf::Bytes bytesOf(const std::filesystem::path& folder, const std::string& uri, std::uint64_t maxBytes) {
    const std::string place = quoted(uri);
    if (uri.starts_with('#'))
        gltf::fail(place, "expected something that the scene's file holds for its lights, or a file's name");
    if (gltf::isDataUri(uri)) return gltf::decodeDataUri(uri, place);
    return gltf::readFile(gltf::resolveUri(folder, uri, place), maxBytes, place);
}

template<typename T, typename Read>
Result<std::shared_ptr<const T>> found(std::map<std::string, Result<std::shared_ptr<const T>>>& known,
                                       const std::string& uri, Read&& read) {
    if (uri.empty()) return std::shared_ptr<const T>();
    const auto at = known.find(uri);
    if (at != known.end()) return at->second;
    return known.emplace(uri, read(uri)).first->second;
}

} // namespace

Result<std::shared_ptr<const IesProfile>> SceneFiles::readProfile(const std::string& uri) const {
    try {
        const gltf::Bytes bytes = bytesOf(folder_, uri, kMostProfileBytes);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        Result<IesProfile> profile = parseIes(text, quoted(uri));
        if (!profile) return Error{profile.error()};
        return std::make_shared<const IesProfile>(std::move(profile.value()));
    } catch (const gltf::ImportFailure& failure) {
        return Error{failure.text};
    }
}

Result<std::shared_ptr<const Image>> SceneFiles::decodeLocked(std::span<const std::uint8_t> bytes,
                                                              const std::string& name) {
    if (pictures_ == Pictures::LeaveOut) {
        const auto header = decodedImageBytes(bytes, name);
        if (!header) return Error{header.error()};
        return std::shared_ptr<const Image>();
    }
    fileBytes_ += bytes.size();
    const std::uint64_t limit = kFreeImageBytes + kImageTimesFile * fileBytes_;
    ImageImportOptions options;
    options.maxDecodedBytes = limit > decodedBytes_ ? limit - decodedBytes_ : 1;
    Result<Image> image = importImage(bytes, name, options);
    if (!image) return Error{image.error()};
    decodedBytes_ += image.value().rgba8.size() + sizeof(float) * image.value().rgbaF32.size();
    return std::make_shared<const Image>(std::move(image.value()));
}

Result<std::shared_ptr<const Image>> SceneFiles::readImage(const std::string& uri) {
    try {
        return decodeLocked(bytesOf(folder_, uri, UINT64_MAX), quoted(uri));
    } catch (const gltf::ImportFailure& failure) {
        return Error{failure.text};
    }
}

Result<std::shared_ptr<const Image>> SceneFiles::decode(std::span<const std::uint8_t> bytes,
                                                        const std::string& name) {
    const std::lock_guard lock(mutex_);
    return decodeLocked(bytes, name);
}

bool SceneFiles::knows(const std::string& uri) const {
    const std::lock_guard lock(mutex_);
    return profiles_.contains(uri) || images_.contains(uri);
}

Result<std::shared_ptr<const IesProfile>> SceneFiles::profile(const std::string& uri) {
    const std::lock_guard lock(mutex_);
    return found(profiles_, uri, [&](const std::string& each) { return readProfile(each); });
}

Result<std::shared_ptr<const Image>> SceneFiles::image(const std::string& uri) {
    const std::lock_guard lock(mutex_);
    return found(images_, uri, [&](const std::string& each) { return readImage(each); });
}

void SceneFiles::keep(const std::string& uri, Result<std::shared_ptr<const IesProfile>> profile) {
    const std::lock_guard lock(mutex_);
    profiles_.insert_or_assign(uri, std::move(profile));
}

void SceneFiles::keep(const std::string& uri, Result<std::shared_ptr<const Image>> image) {
    const std::lock_guard lock(mutex_);
    images_.insert_or_assign(uri, std::move(image));
}

std::filesystem::path SceneFiles::folder() const {
    const std::lock_guard lock(mutex_);
    return folder_;
}

void SceneFiles::moveTo(std::filesystem::path folder) {
    const std::lock_guard lock(mutex_);
    folder_ = std::move(folder);
}

void SceneFiles::forget(const std::string& uri) {
    const std::lock_guard lock(mutex_);
    profiles_.erase(uri);
    images_.erase(uri);
}

namespace {

template<typename T>
void load(const char* name, const Result<std::shared_ptr<const T>>& read, std::shared_ptr<const T>& target,
          std::vector<Error>& errors) {
    target = read ? read.value() : nullptr;
    if (!read) errors.push_back(Error{std::string(name) + ": " + read.error()});
}

} // namespace

std::vector<Error> loadFiles(SceneFiles* files, LightDef& def) {
    std::vector<Error> errors;
    if (!files) return errors; // a document made in memory brings its own
    load("iesProfile", files->profile(def.iesUri), def.ies, errors);
    load("sourceTexture", files->image(def.sourceUri), def.sourceImage, errors);
    load("lightFunctionImage", files->image(def.function.imageUri), def.function.image, errors);
    return errors;
}

std::vector<Error> loadFiles(SceneFiles* files, Dome& dome) {
    std::vector<Error> errors;
    if (files) load("domeImage", files->image(dome.imageUri), dome.image, errors);
    return errors;
}

} // namespace kilolux
