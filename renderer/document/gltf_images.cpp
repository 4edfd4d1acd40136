// The images that materials use, decoded on two threads within one budget for the whole scene. An image that
// cannot be read costs a warning, not the scene.
#include "renderer/document/gltf_images.h"

#include "renderer/document/image_import.h"
#include "renderer/document/task_watch.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace kilolux::gltf {

namespace {

constexpr std::uint64_t kFreeImageBytes = 48ull << 20;
constexpr std::uint64_t kImageTimesFile = 8;
constexpr int kDecodeThreads = 2;

} // namespace

int ImageLoader::request(int gltfImage, std::string_view place) {
    if (!context_.options.loadImages) return -1;
    if (const auto known = byGltfImage_.find(gltfImage); known != byGltfImage_.end()) return known->second;
    int slot = -1;
    try {
        slot = addSource(gltfImage);
    } catch (const ImportFailure& failure) {
        context_.warn(place, "the texture is left out; {}", failure.text);
    }
    byGltfImage_[gltfImage] = slot;
    return slot;
}

int ImageLoader::addSource(int gltfImage) {
    const Json& json = context_.json["images"][gltfImage];
    const std::string place = fmt::format("/images/{}", gltfImage);
    Source source;
    source.place = place;
    std::string key;
    if (const auto view = json.find("bufferView"); view != json.end()) {
        key = fmt::format("bufferView {}", view->get<int>());
        source.bytes = bufferViewBytes(context_, view->get<int>(), place + "/bufferView");
        source.name = json.value("name", key);
    } else if (const auto uri = json.find("uri"); uri == json.end()) {
        fail(place, "expected the property 'uri' or 'bufferView'");
    } else if (const auto& text = uri->get_ref<const std::string&>(); isDataUri(text)) {
        key = place;
        source.storage = decodeDataUri(text, place + "/uri");
        source.bytes = source.storage;
        source.name = json.value("name", "data URI");
    } else {
        const auto path = resolveUri(context_.path.parent_path(), text, place + "/uri");
        key = path.string();
        source.name = text;
        if (!bySource_.contains(key)) {
            source.storage = readFile(path, UINT64_MAX, place + "/uri", &context_);
            context_.fileBytes += source.storage.size();
            source.bytes = source.storage;
        }
    }
    const auto [it, isNew] = bySource_.emplace(key, static_cast<int>(sources_.size()));
    if (isNew) sources_.push_back(std::move(source));
    return it->second;
}

void ImageLoader::chooseBudgets() {
    std::uint64_t total = 0;
    for (Source& source : sources_) {
        const auto bytes = decodedImageBytes(source.bytes, source.name);
        source.budgetBytes = bytes ? bytes.value() : 1;
        total += source.budgetBytes;
    }
    const std::uint64_t limit = kFreeImageBytes + kImageTimesFile * context_.fileBytes;
    // The largest picture is halved (a quarter of its bytes) until all fit: what is lost is lost where it
    // shows least.
    while (total > limit) {
        const auto largest =
            std::max_element(sources_.begin(), sources_.end(),
                             [](const Source& a, const Source& b) { return a.budgetBytes < b.budgetBytes; });
        if (largest->budgetBytes <= 64) break;
        const std::uint64_t halved = largest->budgetBytes / 4 + 64;
        total -= largest->budgetBytes - halved;
        largest->budgetBytes = halved;
        context_.warnOnce("halved " + largest->place, largest->place,
                          "'{}' is read at a lower resolution, expected images of at most {} MiB in all",
                          printable(largest->name), limit >> 20);
    }
}

std::vector<bool> ImageLoader::load() {
    chooseBudgets();
    std::vector<std::shared_ptr<const Image>> images(sources_.size());
    std::vector<std::string> errors(sources_.size());
    std::atomic<std::size_t> next = 0;
    TaskWatch* const watch = context_.options.watch;
    const auto work = [&] {
        for (std::size_t i = next++; i < sources_.size(); i = next++) {
            if (watch && watch->isCancelled()) return;
            if (watch) watch->reach("Reading textures", 0.4 + 0.3 * double(i) / double(sources_.size()));
            ImageImportOptions options;
            options.maxDecodedBytes = sources_[i].budgetBytes;
            auto image = importImage(sources_[i].bytes, printable(sources_[i].name), options);
            if (image) {
                images[i] = std::make_shared<const Image>(std::move(image.value()));
            } else {
                errors[i] = image.error();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int i = 1; i < kDecodeThreads && sources_.size() > 1; ++i)
            threads.emplace_back(work);
        work();
    }
    if (watch && watch->isCancelled()) throw ImportCancelled();
    std::vector<bool> loaded(sources_.size());
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        loaded[i] = images[i] != nullptr;
        if (!loaded[i]) context_.warn(sources_[i].place, "the texture is left out; {}", errors[i]);
        // A slot keeps its place, so that references stay valid.
        if (!loaded[i]) images[i] = std::make_shared<const Image>();
    }
    context_.scene.images = std::move(images);
    return loaded;
}

} // namespace kilolux::gltf
