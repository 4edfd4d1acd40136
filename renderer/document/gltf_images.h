// Collects the images that materials ask for, each file once, and decodes them together.
#pragma once

#include "renderer/document/gltf_context.h"

#include <map>

namespace kilolux::gltf {

class ImageLoader {
  public:
    explicit ImageLoader(ImportContext& context) : context_(context) {}

    // Index into Scene::images for an entry of /images, or -1 (with a warning at `place`) if its bytes cannot
    // be had.
    int request(int gltfImage, std::string_view place);

    // Fills Scene::images; false marks slots whose picture is damaged and which must not be referred to.
    std::vector<bool> load();

  private:
    struct Source {
        std::string place;
        std::string name;
        Bytes storage; // empty when `bytes` lie in a buffer
        std::span<const std::uint8_t> bytes;
        std::uint64_t budgetBytes = 0;
    };

    int addSource(int gltfImage);
    void chooseBudgets();

    ImportContext& context_;
    std::map<int, int> byGltfImage_;
    std::map<std::string, int> bySource_;
    std::vector<Source> sources_;
};

} // namespace kilolux::gltf
