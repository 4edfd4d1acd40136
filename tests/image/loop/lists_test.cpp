// Visible light lists: whatever they hold, the mean stays; and what they hold is exactly what the samples of
// the frames before saw.
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/sampling.h"
#include "tests/image/loop/loop_kit.h"

#include <cstring>
#include <map>
#include <random>

namespace kilolux::test {
namespace {

using namespace shared;

using Texels = std::vector<glm::uvec2>;

std::uint32_t entryWord(std::uint32_t slot, std::uint32_t epoch, std::uint32_t age) {
    return slot | epoch << ENTRY_EPOCH_SHIFT | age << ENTRY_AGE_SHIFT;
}

// What was seen of a light: these cells by so many samples, in both windows.
glm::uvec2 seenWords(std::uint32_t cells, std::uint32_t samples) {
    return {cells | cells << SEEN_OLDER_SHIFT, samples | samples << SEEN_OLDER_SHIFT};
}

// ---------------------------------------------------------------------------------------------------------
// Forced lists

constexpr int kWidth = 80, kHeight = 64;
constexpr std::size_t kTiles = (kWidth / LIST_TILE_PX) * (kHeight / LIST_TILE_PX);
constexpr std::uint32_t kLights = 24, kDeadSlot = 3;

// Slots of one tile's list, and the mask, epoch and count that go with them.
struct ForcedList {
    std::vector<std::uint32_t> slots;
    std::uint32_t mask = 0, epoch = 0;
    std::optional<std::uint32_t> count; // other than there are slots
};
using MakeList = std::function<ForcedList(std::mt19937&)>;

Texels forcedLists(const MakeList& make, std::mt19937& random) {
    Texels texels(kTiles * LIST_TEXELS, glm::uvec2(0xffffffffu));
    for (std::size_t tile = 0; tile < kTiles; ++tile) {
        const ForcedList list = make(random);
        glm::uvec2* at = &texels[tile * LIST_TEXELS];
        at[0] = {list.count.value_or(std::uint32_t(list.slots.size())), std::uint32_t(random())};
        for (std::size_t i = 0; i < list.slots.size() && i < LIST_CAPACITY; ++i)
            at[1 + i] = {entryWord(list.slots[i], list.epoch, std::uint32_t(random() % 16)), random() % 5000};
        for (std::size_t i = 0; i < list.slots.size() && i < LIST_CAPACITY; ++i)
            at[LIST_CELLS_AT + i] = seenWords(list.mask, 200);
    }
    return texels;
}

std::vector<std::uint32_t> someSlots(std::mt19937& random, std::size_t count, std::uint32_t below = kLights) {
    std::vector<std::uint32_t> slots;
    while (slots.size() < count)
        slots.push_back(std::uint32_t(random() % below));
    return slots;
}

std::vector<std::uint32_t> sortedSlots(std::mt19937& random, std::size_t count,
                                       std::uint32_t below = kLights) {
    std::vector<std::uint32_t> slots = someSlots(random, count, below);
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    return slots;
}

struct Forced {
    const char* name;
    MakeList make;
    std::uint32_t cells = 0; // of 16, those to which all masks send the rays
};

std::vector<Forced> forcedKinds() {
    std::vector<std::uint32_t> all(kLights);
    for (std::uint32_t i = 0; i < kLights; ++i)
        all[i] = i;
    return {
        {"empty", [](auto&) { return ForcedList{}; }},
        {"full", [all](auto&) { return ForcedList{all}; }},
        {"few", [](auto& random) { return ForcedList{sortedSlots(random, 5)}; }},
        {"duplicated",
         [](auto& random) {
             ForcedList list{someSlots(random, 12)};
             list.slots.insert(list.slots.end(), list.slots.begin(), list.slots.end());
             std::sort(list.slots.begin(), list.slots.end());
             return list;
         }},
        {"unsorted", [](auto& random) { return ForcedList{someSlots(random, 16)}; }},
        {"dead slot only", [](auto&) { return ForcedList{{kDeadSlot}}; }},
        {"foreign slots", [](auto& random) { return ForcedList{sortedSlots(random, 20, 60000)}; }},
        {"wrong epoch",
         [](auto& random) {
             return ForcedList{sortedSlots(random, 10), 1u, 1u + std::uint32_t(random() % 15)};
         }},
        {"first quarter",
         [all](auto&) {
             return ForcedList{all, 0x0033u};
         },
         0x0033u},
        {"last quarter",
         [all](auto&) {
             return ForcedList{all, 0xcc00u};
         },
         0xcc00u},
        {"random masks",
         [all](auto& random) {
             return ForcedList{all, std::uint32_t(random() & 0xffffu)};
         }},
        {"count too large",
         [](auto& random) {
             return ForcedList{sortedSlots(random, 8), 0, 0, 0x7fffffffu};
         }},
    };
}

Scene withoutLight(Scene scene, std::uint64_t id) {
    auto& lights = scene.lights.write();
    std::erase_if(lights, [&](const LightNode& light) { return light.id == id; });
    return scene;
}

// Of the samples of local lights, those in these cells of their light.
double shareInCells(const FrameTargets& targets, std::uint32_t cells) {
    double inCells = 0.0, all = 0.0;
    for (const PixelSample& sample : samplesOf(targets)) {
        if (sample.contribution == 0.0f) continue;
        const std::uint32_t cell = (sample.uv & 0xffffu) / 0x4000u + 4u * (sample.uv >> 30);
        inCells += cells >> cell & 1u;
        all += 1.0;
    }
    return inCells / all;
}

TEST(ListFuzz, AnyListKeepsTheMean) {
    const Scene scene = crowdScene(kLights, 5);
    const Scene edited = withoutLight(scene, kDeadSlot + 1);
    const Replicas reference = splitReference(edited, loopOptions(kWidth, kHeight));
    // The stage's lights are shorter than a tile: without a small maskSize they would have no masks.
    RenderOptions options = loopOptions(kWidth, kHeight, {"raysPerPixel=4", "maskSize=0.1"});
    options.keepTargets = true;
    Loop loop(scene, options);
    loop.frames(1);
    ASSERT_EQ(loop.renderer().lightSlot(kDeadSlot + 1), kDeadSlot);
    loop.renderer().setLights(edited);
    loop.frames(Settings{}.editFrames + 1);
    ASSERT_EQ(loop.renderer().visibleLists().size(), kTiles * LIST_TEXELS);
    std::mt19937 random(11);
    for (const Forced& forced : forcedKinds()) {
        const auto replica = [&] {
            loop.renderer().replaceVisibleLists(forcedLists(forced.make, random));
            return lightOf(loop.next());
        };
        expectSameMean(gather(replica, 0.001, 300), reference, forced.name);
        if (forced.cells == 0) continue;
        const double share = shareInCells(loop.targets(), forced.cells);
        std::printf("   %.3f of the samples in the cells of the masks\n", share);
        EXPECT_GT(share, 0.4) << forced.name << ": masks are not in use";
    }
}

// ---------------------------------------------------------------------------------------------------------
// What the lists hold

struct Entry {
    std::uint32_t slot = 0, epoch = 0, age = 0, energy = 0;
    std::uint32_t recent = 0, older = 0, samples = 0, olderSamples = 0;
    bool operator==(const Entry&) const = default;
};
void PrintTo(const Entry& e, std::ostream* out) {
    *out << "slot " << e.slot << " epoch " << e.epoch << " age " << e.age << " energy " << e.energy
         << " recent " << e.recent << " by " << e.samples << " older " << e.older << " by " << e.olderSamples;
}
using List = std::map<std::uint32_t, Entry>;

// Fails where a list is not sorted by slot.
std::vector<List> readLists(const Texels& texels) {
    std::vector<List> lists(texels.size() / LIST_TEXELS);
    for (std::size_t tile = 0; tile < lists.size(); ++tile) {
        const glm::uvec2* at = &texels[tile * LIST_TEXELS];
        std::uint32_t least = 0;
        for (std::uint32_t i = 1; i <= at[0].x; ++i) {
            const std::uint32_t word = at[i].x;
            const glm::uvec2 seen = at[LIST_CELLS_AT + i - 1];
            const Entry e{word & ENTRY_SLOT_MASK,
                          word >> ENTRY_EPOCH_SHIFT & 15u,
                          word >> ENTRY_AGE_SHIFT & 15u,
                          at[i].y,
                          seen.x & SEEN_MASK,
                          seen.x >> SEEN_OLDER_SHIFT,
                          seen.y & SEEN_MASK,
                          seen.y >> SEEN_OLDER_SHIFT};
            EXPECT_GE(e.slot, least) << "tile " << tile;
            least = e.slot + 1;
            lists[tile][e.slot] = e;
        }
    }
    return lists;
}

// A visible sample of a pixel.
struct Seen {
    std::uint32_t slot, cell, energy;
};

// By tile, of frames with one ray per pixel.
std::vector<std::vector<Seen>> seenByTile(const FrameTargets& targets, int width, int height) {
    constexpr std::uint32_t kDirectionalList = 2;
    const int tilesX = (width + 7) / 8, tilesY = (height + 7) / 8;
    std::vector<std::vector<Seen>> result(std::size_t(tilesX * tilesY));
    const std::vector<PixelSample> samples = samplesOf(targets);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel = std::size_t(y * width + x);
            const PixelSample& sample = samples[pixel];
            std::uint32_t ray;
            std::memcpy(&ray, targets.named("rayResults").texels.data() + 4 * pixel, 4);
            if ((ray & RAY_STATE_MASK) != RAY_VISIBLE || sample.list == kDirectionalList) continue;
            result[std::size_t(y / 8 * tilesX + x / 8)].push_back(
                {sample.slot, ray >> RAY_CELL_SHIFT & 15u,
                 std::uint32_t(std::clamp(sample.weight * 256.0f, 1.0f, 65535.0f))});
        }
    }
    return result;
}

// The list that follows, in the words of shared/sampling.h, before weak entries are dropped.
List nextList(const List& before, const std::vector<Seen>& seen, std::uint32_t frame, std::uint32_t memory) {
    List list;
    for (auto [slot, e] : before) {
        if (++e.age > memory) continue;
        if (frame % ENTRY_WINDOW == 0) {
            e.older = e.recent;
            e.olderSamples = e.samples;
            e.recent = e.samples = 0;
        }
        e.energy -= e.energy / 4;
        list[slot] = e;
    }
    std::map<std::uint32_t, std::uint32_t> energy;
    for (const Seen& s : seen) {
        Entry& e = list[s.slot];
        e.slot = s.slot;
        e.recent |= 1u << s.cell;
        ++e.samples;
        e.age = 0;
        energy[s.slot] += s.energy;
    }
    for (const auto& [slot, sum] : energy)
        list[slot].energy = std::max(list[slot].energy, sum);
    return list;
}

// The `length` entries of most energy; of equal ones the last goes first.
List strongest(List list, std::size_t length) {
    while (list.size() > length) {
        auto weakest = list.begin();
        for (auto e = list.begin(); e != list.end(); ++e) {
            if (e->second.energy <= weakest->second.energy) weakest = e;
        }
        list.erase(weakest);
    }
    return list;
}

TEST(Lists, HoldWhatTheSamplesSaw) {
    constexpr int width = 45, height = 30; // tiles beyond the border
    for (const std::uint32_t length : {32u, 4u}) {
        constexpr std::uint32_t memory = 5;
        RenderOptions options = loopOptions(width, height,
                                            {"listMemory=" + std::to_string(memory), "cellCandidates=24",
                                             "hiddenShare=0.3", "listLength=" + std::to_string(length)});
        options.keepTargets = true;
        Loop loop(crowdScene(24, 6), options);
        std::vector<List> before(6 * 4);
        std::size_t entries = 0, carried = 0, masks = 0;
        for (std::uint32_t frame = 0; frame < 18; ++frame) {
            loop.frames(1);
            const auto seen = seenByTile(loop.targets(), width, height);
            const std::vector<List> after = readLists(loop.renderer().visibleLists());
            ASSERT_EQ(after.size(), before.size());
            for (std::size_t tile = 0; tile < after.size(); ++tile) {
                const List wanted = strongest(nextList(before[tile], seen[tile], frame, memory), length);
                EXPECT_EQ(after[tile], wanted) << "tile " << tile << ", frame " << frame;
                for (const auto& [slot, e] : after[tile]) {
                    ++entries;
                    carried += e.age > 0;
                    masks += (e.recent | e.older) != 0xffffu;
                }
            }
            before = after;
            if (HasFailure()) break;
        }
        EXPECT_GT(entries, 500u);
        EXPECT_GT(carried, entries / 50);
        EXPECT_GT(masks, entries / 50);
    }
}

// The cell that a ray reports is that of the sample, but where a point below the horizon was drawn again.
// Of rectangles and disks: round lights may mirror a point to the side that is seen.
TEST(Lists, CellsAreThoseOfTheSamples) {
    RenderOptions options = loopOptions(64, 48, {"areaMasks=false"});
    options.keepTargets = true;
    Loop loop(crowdScene(24, 6), options);
    loop.frames(2);
    const FrameTargets targets = loop.targets();
    const std::vector<PixelSample> samples = samplesOf(targets);
    int visible = 0, same = 0;
    for (std::size_t pixel = 0; pixel < targets.pixels(); ++pixel) {
        const PixelSample& sample = samples[pixel];
        std::uint32_t ray;
        std::memcpy(&ray, targets.named("rayResults").texels.data() + 4 * pixel, 4);
        if ((ray & RAY_STATE_MASK) != RAY_VISIBLE || sample.slot % 7 > 1) continue;
        const std::uint32_t column = (sample.uv & 0xffffu) >> 14, row = sample.uv >> 30;
        ++visible;
        same += (ray >> RAY_CELL_SHIFT & 15u) == column + 4 * row;
    }
    EXPECT_GT(visible, 200);
    EXPECT_GT(same, 0.97 * visible);
}

// Most lights are above a roof: rays go to the few below once those have been seen.
TEST(Lists, SendTheRaysToWhatWasSeen) {
    SceneBuilder b;
    b.scene = crowdScene(24, 8);
    for (std::size_t i = 3; i < b.scene.lights.size(); ++i) {
        Node& node = b.scene.nodes.write()[std::size_t(b.scene.lights[i].node)];
        node.worldFromNode[3].y += 2.0;
        node.localFromNode = node.worldFromNode;
    }
    b.quad(floorAt({0, 3.0, 0}), 12, 12, 0);
    const auto useful = [&](const char* guiding) {
        Loop loop(b.scene, loopOptions(64, 48, {guiding, "cellCandidates=24", "exposureEv100=5"}));
        loop.frames(12);
        return loop.renderer().statistics().usefulRaysPerPixelMean;
    };
    const double guided = useful("guiding=true"), plain = useful("guiding=false");
    std::printf("useful rays per pixel: %.3f guided, %.3f not\n", guided, plain);
    EXPECT_GT(guided, plain + 0.3 * (1.0 - plain));
}

// More lights are seen than a list holds: rays to the others arrive, and so they are no longer held down.
TEST(Lists, TooShortOnesLeaveRaysToTheOthers) {
    const Scene scene = crowdScene(24, 8);
    const auto squaredError = [&](const char* share) {
        Loop loop(scene, loopOptions(64, 48, {"listLength=4", "cellCandidates=24", share}));
        loop.frames(12);
        std::vector<double> sum, squares;
        constexpr int kFrames = 24;
        for (int i = 0; i < kFrames; ++i) {
            const Picture picture = loop.next();
            sum.resize(picture.rgb.size());
            squares.resize(picture.rgb.size());
            for (std::size_t at = 0; at < sum.size(); ++at) {
                sum[at] += picture.rgb[at] / kFrames;
                squares[at] += double(picture.rgb[at]) * picture.rgb[at] / kFrames;
            }
        }
        double variance = 0.0;
        for (std::size_t at = 0; at < sum.size(); ++at)
            variance += squares[at] - sum[at] * sum[at];
        return variance;
    };
    const double ratio = squaredError("hiddenSeenShare=0.8") / squaredError("hiddenSeenShare=0.01");
    std::printf("variance beside lists that are too short: %.3f of what it was\n", ratio);
    EXPECT_LT(ratio, 0.6);
}

} // namespace
} // namespace kilolux::test
