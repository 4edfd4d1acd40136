#include "ui/picture_export.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

std::string exportPathFor(const std::filesystem::path& scene, const std::string& view) {
    std::string name = scene.stem().string() + "-" + (view.empty() ? "picture" : view);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ':' || c == '/'; }, '-');
    std::filesystem::path path = scene.parent_path() / (name + ".png");
    std::error_code unreadable;
    for (int i = 2; std::filesystem::exists(path, unreadable) && i < 1000; ++i)
        path = scene.parent_path() / fmt::format("{}-{}.png", name, i);
    return path.string();
}

std::optional<Error> writePictureFile(const std::string& path, const Picture& picture) {
    const Result<PictureFormat> format = pictureFormat(path);
    if (!format) return Error{format.error()};
    if (format.value() == PictureFormat::Png)
        return writePng(path, picture.width, picture.height, picture.srgb8);
    const FloatImage linear{picture.width, picture.height, 3, picture.rgb};
    if (format.value() == PictureFormat::Hdr) return writeHdr(path, linear);
    return writeExr(path, linear, ExrDepth::Float);
}

std::shared_ptr<const ExportResult> exportPicture(RenderThread& thread, const std::string& path) {
    auto result = std::make_shared<ExportResult>();
    thread.post([result, path](Renderer& renderer) {
        const std::optional<Error> failed = writePictureFile(path, renderer.picture());
        result->failed = bool(failed);
        result->text = failed ? failed->message : fmt::format("Wrote '{}'", path);
        result->done = true;
    });
    return result;
}

} // namespace kilolux
