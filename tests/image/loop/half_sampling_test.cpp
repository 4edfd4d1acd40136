// Lights chosen at half resolution: a pixel takes its sample from one of the four nearest half-resolution
// pixels, and never from one whose surface is another.
#include "shaders/shared/sampling.h"
#include "tests/image/loop/loop_kit.h"

#include <array>
#include <cstring>
#include <map>

namespace kilolux::test {
namespace {

constexpr int kWidth = 80, kHeight = 64, kHalfWidth = kWidth / 2, kHalfHeight = kHeight / 2;

// Point on the light, contribution and weight: what tells a sample from all others.
using SampleKey = std::array<std::uint32_t, 3>;

struct KeyedSample {
    SampleKey key;
    bool chosen, reconstructed;
};

KeyedSample sampleAt(const FrameTargets& targets, const char* name, std::size_t at) {
    std::uint32_t words[4];
    std::memcpy(words, targets.named(name).texels.data() + 16 * at, 16);
    return {{words[1], words[2], words[3]}, words[2] != 0, (words[0] & shared::SAMPLE_RECONSTRUCTED) != 0};
}

// By the words of upsample_samples: alike in depth and normal.
bool isLike(const PixelSurface& a, const PixelSurface& b) {
    if (!a.seen || !b.seen) return false;
    const double apart = std::abs(a.depthM - b.depthM) / a.depthM;
    return std::exp2(-50.0 * apart) * std::pow(std::max(glm::dot(a.normalWs, b.normalWs), 0.0), 8.0) > 0.009;
}

struct Found {
    int samples = 0, ownBlock = 0; // of those that the first sample of a half-resolution pixel became
    int farOff = 0, unlike = 0;
    int unlikeNeighbours = 0; // blocks that were not to be taken from
};

Found originsOf(const FrameTargets& targets) {
    std::vector<PixelSurface> surfaces;
    for (std::size_t i = 0; i < targets.pixels(); ++i)
        surfaces.push_back(targets.surface(i));
    const auto blockIsLike = [&](int x, int y, const PixelSurface& surface) {
        for (int i = 0; i < 4; ++i) {
            if (isLike(surface, surfaces[std::size_t((2 * y + i / 2) * kWidth + 2 * x + i % 2)])) return true;
        }
        return false;
    };
    std::map<SampleKey, int> origins;
    for (int i = 0; i < kHalfWidth * kHalfHeight; ++i) {
        const KeyedSample sample = sampleAt(targets, "samplesHalf", std::size_t(i));
        if (sample.chosen) origins[sample.key] = i;
    }
    Found found;
    for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
        const int x = pixel % kWidth, y = pixel / kWidth;
        const PixelSurface& surface = surfaces[std::size_t(pixel)];
        const KeyedSample sample = sampleAt(targets, "samples", std::size_t(pixel));
        const auto origin = origins.find(sample.key);
        if (!sample.chosen || sample.reconstructed || origin == origins.end()) continue;
        const int halfX = origin->second % kHalfWidth, halfY = origin->second / kHalfWidth;
        const int cornerX = (x + 1) / 2 - 1, cornerY = (y + 1) / 2 - 1; // of the four nearest
        ++found.samples;
        found.ownBlock += halfX == x / 2 && halfY == y / 2;
        found.farOff += halfX < cornerX || halfX > cornerX + 1 || halfY < cornerY || halfY > cornerY + 1;
        found.unlike += !blockIsLike(halfX, halfY, surface);
        for (int i = 0; i < 4; ++i) {
            const int u = cornerX + i % 2, v = cornerY + i / 2;
            if (u >= 0 && v >= 0 && u < kHalfWidth && v < kHalfHeight)
                found.unlikeNeighbours += !blockIsLike(u, v, surface);
        }
    }
    return found;
}

TEST(HalfSampling, SamplesComeFromLikeNeighbours) {
    for (const char* sampling : {"sampling=checkerboard", "sampling=rooks"}) {
        RenderOptions options = loopOptions(kWidth, kHeight, {sampling});
        options.keepTargets = true;
        Loop loop(crowdScene(24, 5), options);
        Found all;
        for (int frame = 0; frame < 4; ++frame) {
            loop.frames(1);
            const Found found = originsOf(loop.targets());
            all.samples += found.samples;
            all.ownBlock += found.ownBlock;
            all.unlikeNeighbours += found.unlikeNeighbours;
            EXPECT_EQ(found.farOff, 0) << sampling << ", frame " << frame;
            EXPECT_EQ(found.unlike, 0) << sampling << ", frame " << frame;
        }
        const double own = double(all.ownBlock) / all.samples;
        std::printf("%s: %d samples, %.2f from the own block, %d neighbours of another surface\n", sampling,
                    all.samples, own, all.unlikeNeighbours);
        EXPECT_GT(all.samples, kWidth * kHeight / 2); // a quarter of them, over four frames
        EXPECT_GT(all.unlikeNeighbours, 200);
        EXPECT_GT(own, 0.3) << "by bilinear chance";
        EXPECT_LT(own, 0.7);
    }
}

} // namespace
} // namespace kilolux::test
