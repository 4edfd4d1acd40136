// Imports one file, a scene or an image, and says what came of it; the tests run it once per file of the
// corpora, so that a crash, a hang or a peak of memory is that file's alone. Exit code 0: opened, 2: refused
// with one message.
#include "renderer/document/gltf_import.h"
#include "renderer/document/image_import.h"

#include <fmt/format.h>
#include <string_view>
#include <sys/resource.h>

namespace {

// Peak resident memory as the kernel counts it.
long peakKiB() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

int refuse(const std::string& message) {
    fmt::print(stderr, "{}\n", message);
    return 2;
}

int importImageFile(const char* path) {
    const auto image = kilolux::importImage(path);
    if (!image) return refuse(image.error());
    fmt::print("{} x {} {}, peak {} KiB\n", image.value().width, image.value().height,
               image.value().rgba8.empty() ? "float" : "8 bit", peakKiB());
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2 && !(argc == 3 && std::string_view(argv[1]) == "--image")) {
        return refuse("usage: kilolux_import [--image] FILE");
    }
    if (argc == 3) return importImageFile(argv[2]);
    const auto scene = kilolux::importGltf(argv[1]);
    if (!scene) return refuse(scene.error());
    const kilolux::Scene& opened = scene.value();
    const auto bounds = kilolux::worldBounds(opened);
    fmt::print("{} triangles, {} lights of {} definitions, {} materials, {} images, {} cameras, size {:.3g} "
               "x {:.3g} x "
               "{:.3g} m, peak {} KiB\n",
               kilolux::triangleCount(opened), opened.lights.size(), opened.lightDefs.size(),
               opened.materials.size(), opened.images.size(), opened.cameras.size(),
               bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y, bounds.max.z - bounds.min.z,
               peakKiB());
    for (const std::string& warning : opened.warnings)
        fmt::print("warning: {}\n", warning);
    return 0;
}
