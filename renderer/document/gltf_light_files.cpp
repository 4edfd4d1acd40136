// Profiles and pictures of lights that lie in the scene's own file.
#include "renderer/document/gltf_context.h"
#include "renderer/document/scene_files.h"

#include <charconv>

namespace kilolux::gltf {

namespace {

// N of "#/KEY/N" where the document has that many; -1 otherwise.
int indexIn(const Json& document, std::string_view uri, std::string_view key) {
    const std::string start = fmt::format("#/{}/", key);
    if (!uri.starts_with(start)) return -1;
    const std::string_view digits = uri.substr(start.size());
    int index = -1;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const auto array = document.find(key);
    const bool good = code == std::errc() && end == digits.data() + digits.size() && index >= 0 &&
                      array != document.end() && index < static_cast<int>(array->size());
    return good ? index : -1;
}

void keepProfile(ImportContext& context, const std::string& uri) {
    const int view = indexIn(context.json, uri, "bufferViews");
    if (view < 0 || context.scene.files->knows(uri)) return;
    Result<std::shared_ptr<const IesProfile>> kept = std::shared_ptr<const IesProfile>();
    try {
        const std::span<const std::uint8_t> bytes = bufferViewBytes(context, view, uri);
        Result<IesProfile> read =
            parseIes({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "'" + uri + "'");
        kept = read ? decltype(kept)(std::make_shared<const IesProfile>(std::move(read.value())))
                    : decltype(kept)(Error{read.error()});
    } catch (const ImportFailure& failure) {
        kept = Error{failure.text};
    }
    context.scene.files->keep(uri, std::move(kept));
}

// An image of the document that is embedded, or a file of its own.
void keepPicture(ImportContext& context, const std::string& uri) {
    const int index = indexIn(context.json, uri, "images");
    if (index < 0 || context.scene.files->knows(uri)) return;
    const Json& image = context.json["images"][index];
    Result<std::shared_ptr<const Image>> kept = std::shared_ptr<const Image>();
    try {
        if (const auto view = image.find("bufferView"); view != image.end()) {
            kept = context.scene.files->decode(bufferViewBytes(context, view->get<int>(), uri), uri);
        } else if (const auto own = image.find("uri"); own != image.end()) {
            kept = context.scene.files->image(own->get<std::string>());
        } else {
            kept = Error{uri + ": expected the property 'uri' or 'bufferView'"};
        }
    } catch (const ImportFailure& failure) {
        kept = Error{failure.text};
    }
    context.scene.files->keep(uri, std::move(kept));
}

} // namespace

void keepLightFiles(ImportContext& context, const LightDef& def) {
    if (!context.scene.files) return;
    keepProfile(context, def.iesUri);
    keepPicture(context, def.sourceUri);
    keepPicture(context, def.function.imageUri);
}

void keepLightFiles(ImportContext& context, const Dome& dome) {
    if (context.scene.files) keepPicture(context, dome.imageUri);
}

} // namespace kilolux::gltf
