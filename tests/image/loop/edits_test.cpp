// Lights edited between two frames: the mean of the very next raw frame is the new scene's, whatever lists
// and slots were made for the old one; a light that is gone leaves nothing.
#include "renderer/light_slots.h"
#include "shaders/shared/sampling.h"
#include "tests/image/loop/loop_kit.h"

#include <algorithm>

namespace kilolux::test {
namespace {

using namespace shared;

constexpr std::uint64_t kEdited = 3, kOther = 8; // light ids

LightNode& lightById(Scene& scene, std::uint64_t id) {
    auto& lights = scene.lights.write();
    return *std::find_if(lights.begin(), lights.end(),
                         [&](const LightNode& light) { return light.id == id; });
}

LightDef& defById(Scene& scene, std::uint64_t id) {
    return scene.lightDefs.write()[std::size_t(lightById(scene, id).def)];
}

void deleteLight(Scene& scene, std::uint64_t id) {
    std::erase_if(scene.lights.write(), [&](const LightNode& light) { return light.id == id; });
}

void addLight(Scene& scene, std::uint64_t id) {
    LightDef def = lightDef(LightType::Rect, 3000, LightUnit::Lumen);
    def.widthM = 0.8;
    def.heightM = 0.4;
    def.rangeM = 6.0;
    Node node;
    node.localFromNode = node.worldFromNode = lookingAlong({1.2, 1.9, 1.0}, {-0.3, -1.0, -0.3});
    scene.lightDefs.write().push_back(def);
    scene.nodes.write().push_back(node);
    scene.lights.write().push_back(
        {.id = id, .node = int(scene.nodes.size()) - 1, .def = int(scene.lightDefs.size()) - 1});
}

struct LightEdit {
    const char* name;
    std::function<void(Scene&)> edit;
    bool backwards = false; // the edit is taken back between the frames
    bool seen = true;       // it changes the picture, not only who is who
};

void PrintTo(const LightEdit& edit, std::ostream* out) {
    *out << edit.name;
}

const LightEdit kEdits[] = {
    {"delete", [](Scene& s) { deleteLight(s, kEdited); }},
    {"undo", [](Scene& s) { deleteLight(s, kEdited); }, true},
    {"add", [](Scene& s) { addLight(s, 100); }},
    {"mute", [](Scene& s) { lightById(s, kEdited).muted = true; }},
    {"unmute", [](Scene& s) { lightById(s, kEdited).muted = true; }, true},
    {"swap", [](Scene& s) { std::swap(lightById(s, kEdited).node, lightById(s, kOther).node); }},
    {"swapIds", [](Scene& s) { std::swap(lightById(s, kEdited).id, lightById(s, kOther).id); }, false, false},
    {"retype",
     [](Scene& s) {
         LightDef& def = defById(s, kEdited);
         def.type = def.type == LightType::Rect ? LightType::Sphere : LightType::Rect;
         def.radiusM = 0.2;
     }},
    {"resize", [](Scene& s) { defById(s, 2).widthM *= 2.0; }},
    {"allAtOnce",
     [](Scene& s) {
         deleteLight(s, kEdited);
         addLight(s, 100);
         addLight(s, 101);
         defById(s, 1).intensity *= 3.0;
         lightById(s, 5).muted = true;
         std::reverse(s.lights.write().begin(), s.lights.write().end());
     }},
};

class EditMatrix : public testing::TestWithParam<LightEdit> {};

TEST_P(EditMatrix, NextFrameHasTheNewMean) {
    Scene before = crowdScene(12, 5), after = before;
    GetParam().edit(after);
    if (GetParam().backwards) std::swap(before, after);
    const RenderOptions options = loopOptions(64, 48, {"raysPerPixel=4"});
    const Replicas reference = splitReference(after, options), old = splitReference(before, options);
    Loop loop(before, options);
    loop.frames(8);
    const auto replica = [&] {
        loop.renderer().setLights(before);
        loop.frames(2);
        loop.renderer().setLights(after);
        return lightOf(loop.next());
    };
    expectSameMean(gather(replica, 0.0015, 160), reference, GetParam().name);
    // The edit is one that the test would see.
    double worst = 0.0;
    for (int value = 0; value < Light::Count; ++value)
        worst = std::max(worst, std::abs(old.mean(value).mean / reference.mean(value).mean - 1.0));
    EXPECT_EQ(worst > 0.03, GetParam().seen) << worst;
}

INSTANTIATE_TEST_SUITE_P(Edits, EditMatrix, testing::ValuesIn(kEdits),
                         [](const auto& tested) { return tested.param.name; });

// The only light with red in it goes, by deletion and by muting.
TEST(Edits, GoneLightLeavesNothing) {
    Scene scene = crowdScene(12, 5);
    for (LightDef& def : scene.lightDefs.write())
        def.color.r = 0.0;
    defById(scene, kEdited).color = {1.0, 0.0, 0.0};
    Scene deleted = scene, muted = scene;
    deleteLight(deleted, kEdited);
    lightById(muted, kEdited).muted = true;
    for (const char* sampling : {"sampling=full", "sampling=rooks"}) {
        Loop loop(scene, loopOptions(64, 48, {sampling}));
        for (const Scene& gone : {deleted, muted}) {
            loop.renderer().setLights(scene);
            loop.frames(5);
            ASSERT_GT(lightOf(loop.next()).values[Light::Red], 0.0);
            loop.renderer().setLights(gone);
            for (int frame = 0; frame < 3; ++frame) {
                const Light light = lightOf(loop.next());
                EXPECT_EQ(light.values[Light::Red], 0.0);
                EXPECT_GT(light.values[Light::Green], 0.0);
            }
        }
    }
}

// Entries of the lists for a slot, over all tiles: the first word, and the cells that were seen.
std::vector<glm::uvec2> entriesOf(Loop& loop, std::uint32_t slot) {
    const std::vector<glm::uvec2> texels = loop.renderer().visibleLists();
    std::vector<glm::uvec2> entries;
    for (std::size_t first = 0; first < texels.size(); first += LIST_TEXELS) {
        for (std::uint32_t i = 1; i <= texels[first].x; ++i) {
            if ((texels[first + i].x & ENTRY_SLOT_MASK) == slot)
                entries.push_back({texels[first + i].x, texels[first + LIST_CELLS_AT + i - 1].x});
        }
    }
    return entries;
}

TEST(Edits, ListsForgetTheDeadAndTheMasksOfTheChanged) {
    Scene scene = crowdScene(12, 5);
    Loop loop(scene, loopOptions(64, 48, {"listMemory=14"}));
    loop.frames(12);
    const std::uint32_t gone = loop.renderer().lightSlot(kEdited), changed = loop.renderer().lightSlot(1);
    EXPECT_GT(entriesOf(loop, gone).size(), 10u);
    EXPECT_GT(entriesOf(loop, changed).size(), 10u);
    const auto olderMasks = [&] {
        const std::vector<glm::uvec2> entries = entriesOf(loop, changed);
        return std::count_if(entries.begin(), entries.end(),
                             [](glm::uvec2 entry) { return entry.y >> SEEN_OLDER_SHIFT != 0u; });
    };
    EXPECT_GT(olderMasks(), 10);
    deleteLight(scene, kEdited);
    defById(scene, 1).intensity *= 1.5;
    loop.renderer().setLights(scene);
    loop.frames(1);
    EXPECT_EQ(olderMasks(), 0);
    const std::vector<glm::uvec2> kept = entriesOf(loop, changed);
    EXPECT_GT(kept.size(), 10u) << "what was seen before stays on the list";
    for (const glm::uvec2& entry : kept)
        EXPECT_EQ(entry.x >> ENTRY_EPOCH_SHIFT & 15u, 1u);
    // A dead slot marks its tiles while the edit is fresh, no longer.
    loop.frames(Settings{}.editFrames);
    EXPECT_EQ(entriesOf(loop, gone).size(), 0u);
}

TEST(Edits, SlotsAreForLife) {
    Scene scene = crowdScene(6, 5);
    Loop loop(scene, loopOptions(16, 16));
    Renderer& renderer = loop.renderer();
    loop.frames(1);
    for (std::uint64_t id = 1; id <= 6; ++id)
        EXPECT_EQ(renderer.lightSlot(id), id - 1);
    const auto edit = [&](const std::function<void(Scene&)>& change) {
        change(scene);
        renderer.setLights(scene);
        loop.frames(1);
    };
    edit([](Scene& s) {
        std::reverse(s.lights.write().begin(), s.lights.write().end());
        lightById(s, 2).muted = true;
    });
    EXPECT_EQ(renderer.lightSlot(2), 1u);
    EXPECT_EQ(renderer.lightSlot(6), 5u);
    const Scene whole = scene;
    edit([](Scene& s) { deleteLight(s, 3); });
    EXPECT_EQ(renderer.lightSlot(3), 0xffffffffu);
    EXPECT_EQ(renderer.lightSlot(4), 3u);
    edit([](Scene& s) { addLight(s, 100); });
    EXPECT_EQ(renderer.lightSlot(100), 6u) << "a fresh grave is not taken";
    loop.frames(int(LightSlots::kRestFrames));
    edit([](Scene& s) { addLight(s, 101); });
    EXPECT_EQ(renderer.lightSlot(101), 2u) << "a rested one is";
    EXPECT_EQ(renderer.lightSlot(100), 6u);
}

} // namespace
} // namespace kilolux::test
