// Light slots: the same for life, dead for a while, edited marks that fade, the strongest fresh ones.
#include "renderer/light_slots.h"
#include "shaders/shared/sampling.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

using namespace shared;

constexpr std::uint32_t kNone = 0xffffffffu;
const auto kEditFrames = std::uint64_t(Settings{}.editFrames);
const auto kEditFirstFrames = std::uint64_t(Settings{}.editFirstFrames);

// Lights by id with an intensity that is their only property.
struct Lights {
    std::vector<std::uint64_t> ids;
    GpuLights records;

    Lights& add(std::uint64_t id, float intensity, std::uint32_t typeFlags = LIGHT_SPHERE, float invRange = 0,
                bool derived = false) {
        ids.push_back(id);
        LightHot hot{};
        hot.invRange = invRange;
        hot.intensity = glm::vec3(intensity);
        hot.typeFlags = typeFlags;
        records.hot.push_back(hot);
        records.cold.push_back({});
        records.rangeDerived.push_back(derived);
        return *this;
    }
};

std::uint32_t epochOf(const LightSlots& slots, std::uint32_t slot) {
    EXPECT_EQ(slots.cold()[slot].epoch & LIGHT_EPOCH_MASK,
              slots.hot()[slot].typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK);
    return slots.cold()[slot].epoch;
}

bool hasFlag(const LightSlots& slots, std::uint32_t slot, std::uint32_t flag) {
    return (slots.hot()[slot].typeFlags & flag) != 0u;
}

void update(LightSlots& slots, const Lights& lights, std::uint64_t frame) {
    slots.update(lights.records, lights.ids, frame);
}

TEST(LightSlots, FirstLightsAreInOrderAndNotEdited) {
    LightSlots slots;
    update(slots, Lights().add(7, 1).add(3, 2).add(9, 3, LIGHT_DIRECTIONAL), 0);
    EXPECT_EQ(slots.slotOf(7), 0u);
    EXPECT_EQ(slots.slotOf(3), 1u);
    EXPECT_EQ(slots.slotOf(9), 2u);
    EXPECT_EQ(slots.slotOf(1), kNone);
    EXPECT_FALSE(slots.edited());
    EXPECT_TRUE(slots.fresh().empty());
    EXPECT_EQ(slots.directional(), std::vector<std::uint32_t>{2});
    for (std::uint32_t slot = 0; slot < 3; ++slot) {
        EXPECT_EQ(epochOf(slots, slot), 0u);
        EXPECT_FALSE(hasFlag(slots, slot, LIGHT_FLAG_EDITED | LIGHT_FLAG_DEAD));
    }
}

// Derived ranges follow the exposure, which edits no light; a range that somebody typed does.
TEST(LightSlots, DerivedRangesAreNoEdits) {
    LightSlots slots;
    update(slots, Lights().add(1, 1, LIGHT_SPHERE, 0.1f, true), 0);
    update(slots, Lights().add(1, 1, LIGHT_SPHERE, 0.2f, true), 1);
    EXPECT_TRUE(slots.changed());
    EXPECT_FALSE(slots.edited());
    EXPECT_EQ(slots.hot()[0].invRange, 0.2f);
    EXPECT_FALSE(hasFlag(slots, 0, LIGHT_FLAG_EDITED));
    update(slots, Lights().add(1, 1, LIGHT_SPHERE, 0.3f), 2);
    EXPECT_TRUE(slots.edited()) << "from derived to typed";
    update(slots, Lights().add(1, 1, LIGHT_SPHERE, 0.4f), 20);
    EXPECT_TRUE(slots.edited());
    update(slots, Lights().add(1, 2, LIGHT_SPHERE, 0.5f, true), 40);
    EXPECT_TRUE(slots.edited()) << "and back";
    update(slots, Lights().add(1, 3, LIGHT_SPHERE, 0.6f, true), 60);
    EXPECT_TRUE(slots.edited()) << "with something else";
}

TEST(LightSlots, OrderDoesNotMatter) {
    LightSlots slots;
    update(slots, Lights().add(1, 1).add(2, 2).add(3, 3), 0);
    update(slots, Lights().add(3, 3).add(1, 1).add(2, 2), 1);
    EXPECT_FALSE(slots.changed());
    EXPECT_FALSE(slots.edited());
    for (std::uint64_t id = 1; id <= 3; ++id) {
        EXPECT_EQ(slots.slotOf(id), id - 1);
        EXPECT_EQ(slots.hot()[id - 1].intensity.x, float(id));
    }
}

TEST(LightSlots, EditsRaiseTheEpochAndAreMarkedForSomeFrames) {
    LightSlots slots;
    update(slots, Lights().add(1, 1).add(2, 2), 0);
    const Lights edited = Lights().add(1, 1).add(2, 5);
    update(slots, edited, 10);
    EXPECT_TRUE(slots.edited());
    EXPECT_TRUE(slots.changed());
    EXPECT_EQ(epochOf(slots, 0), 0u);
    EXPECT_EQ(epochOf(slots, 1), 1u);
    EXPECT_EQ(slots.fresh(), std::vector<std::uint32_t>{1});
    for (std::uint64_t frame = 11; frame < 10 + kEditFrames; ++frame) {
        update(slots, edited, frame);
        EXPECT_FALSE(slots.edited());
        EXPECT_TRUE(hasFlag(slots, 1, LIGHT_FLAG_EDITED)) << frame;
        EXPECT_FALSE(hasFlag(slots, 0, LIGHT_FLAG_EDITED)) << frame;
    }
    update(slots, edited, 10 + kEditFrames);
    EXPECT_FALSE(hasFlag(slots, 1, LIGHT_FLAG_EDITED));
    EXPECT_TRUE(slots.changed()) << "the device must hear of the mark that went";
    EXPECT_TRUE(slots.fresh().empty());
    EXPECT_EQ(epochOf(slots, 1), 1u);
}

// However long a drag goes on, only its first frames count as just edited; after a rest the next one begins
// anew.
TEST(LightSlots, ADragIsJustEditedInItsFirstFrames) {
    LightSlots slots;
    update(slots, Lights().add(1, 1), 0);
    for (std::uint64_t frame = 10; frame <= 20; ++frame) {
        update(slots, Lights().add(1, 2.0f + float(frame)), frame);
        EXPECT_TRUE(hasFlag(slots, 0, LIGHT_FLAG_EDITED)) << frame;
        EXPECT_EQ(hasFlag(slots, 0, LIGHT_FLAG_JUST_EDITED), frame < 10 + kEditFirstFrames) << frame;
    }
    const std::uint64_t rested = 20 + kEditFrames;
    update(slots, Lights().add(1, 22.0f), rested);
    EXPECT_FALSE(hasFlag(slots, 0, LIGHT_FLAG_EDITED));
    update(slots, Lights().add(1, 5.0f), rested + 1);
    EXPECT_TRUE(hasFlag(slots, 0, LIGHT_FLAG_JUST_EDITED));
}

TEST(LightSlots, EditsAreRememberedAsTheSettingsSay) {
    LightSlots slots;
    Settings settings;
    settings.editFrames = 3;
    settings.editFirstFrames = 1;
    settings.freshLights = 1;
    slots.setEditMemory(settings);
    update(slots, Lights().add(1, 1).add(2, 1), 0);
    const Lights edited = Lights().add(1, 2).add(2, 5);
    for (std::uint64_t frame = 10; frame < 15; ++frame) {
        update(slots, edited, frame);
        EXPECT_EQ(hasFlag(slots, 0, LIGHT_FLAG_EDITED), frame < 13) << frame;
        EXPECT_EQ(hasFlag(slots, 0, LIGHT_FLAG_JUST_EDITED), frame < 11) << frame;
        EXPECT_EQ(slots.fresh(), frame < 13 ? std::vector<std::uint32_t>{1} : std::vector<std::uint32_t>{});
    }
}

TEST(LightSlots, EveryFieldCounts) {
    const Lights plain = Lights().add(1, 1);
    const auto epochAfter = [&](auto change) {
        LightSlots slots;
        update(slots, plain, 0);
        Lights lights = plain;
        change(lights.records);
        update(slots, lights, 1);
        return epochOf(slots, 0);
    };
    EXPECT_EQ(epochAfter([](GpuLights&) {}), 0u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.hot[0].positionWs.y = 1.0f; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.hot[0].tangentOct = 9u; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.hot[0].sizeM.y = 1.0f; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.hot[0].shaping.x = 1.0f; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.hot[0].typeFlags = LIGHT_RECT; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.hot[0].typeFlags |= LIGHT_FLAG_MUTED; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) { l.cold[0].rayEndBiasM = 0.1f; }), 1u);
    EXPECT_EQ(epochAfter([](GpuLights& l) {
                  l.tables.shapings.resize(1);
                  l.hot[0].typeFlags |= 1u << LIGHT_SHAPING_SHIFT;
              }),
              1u);
}

// A light's shaping counts, the place where it lies does not.
TEST(LightSlots, ShapingsFollowTheirLights) {
    const auto shaped = [](float depthM, std::uint32_t at, std::uint32_t of) {
        Lights lights = Lights().add(1, 1).add(2, 2);
        lights.records.tables.shapings.resize(of);
        lights.records.tables.shapings[at].doorDepthM = glm::vec4(depthM);
        lights.records.hot[1].typeFlags |= (at + 1u) << LIGHT_SHAPING_SHIFT;
        return lights;
    };
    LightSlots slots;
    update(slots, shaped(0.5f, 0, 1), 0);
    update(slots, shaped(0.5f, 2, 3), 1);
    EXPECT_FALSE(slots.edited()) << "only the place is another";
    ASSERT_EQ(slots.shapings().size(), 1u);
    EXPECT_EQ(slots.hot()[1].typeFlags >> LIGHT_SHAPING_SHIFT, 1u);
    update(slots, shaped(0.7f, 0, 1), 2);
    EXPECT_TRUE(slots.edited());
    EXPECT_EQ(epochOf(slots, 1), 1u);
    EXPECT_EQ(slots.shapings()[0].doorDepthM.x, 0.7f);
    update(slots, Lights().add(1, 1).add(2, 2), 3);
    EXPECT_EQ(epochOf(slots, 1), 2u);
    EXPECT_TRUE(slots.shapings().empty());
}

TEST(LightSlots, GravesRestBeforeTheyAreTaken) {
    LightSlots slots;
    update(slots, Lights().add(1, 1).add(2, 2).add(3, 3), 0);
    update(slots, Lights().add(1, 1).add(3, 3), 5);
    EXPECT_TRUE(slots.edited());
    EXPECT_EQ(slots.slotOf(2), kNone);
    EXPECT_TRUE(hasFlag(slots, 1, LIGHT_FLAG_DEAD));
    EXPECT_TRUE(hasFlag(slots, 1, LIGHT_FLAG_EDITED)) << "tiles that it lit must know";
    EXPECT_EQ(slots.hot()[1].intensity.x, 0.0f);
    EXPECT_TRUE(slots.fresh().empty()) << "the dead are no candidates";
    update(slots, Lights().add(1, 1).add(3, 3).add(4, 4), 5 + LightSlots::kRestFrames - 1);
    EXPECT_EQ(slots.slotOf(4), 3u);
    EXPECT_EQ(slots.slotOf(3), 2u);
    update(slots, Lights().add(1, 1).add(3, 3).add(4, 4).add(5, 5), 5 + LightSlots::kRestFrames);
    EXPECT_EQ(slots.slotOf(5), 1u);
    EXPECT_FALSE(hasFlag(slots, 1, LIGHT_FLAG_DEAD));
    EXPECT_EQ(epochOf(slots, 1), 2u) << "once for the death, once for the new light";
    EXPECT_GT(LightSlots::kRestFrames, 16u) << "a list entry lives for up to 15 frames";
}

// Undo brings a light back under its id; its old slot is still warm, so it gets another one.
TEST(LightSlots, UndoneDeletionIsANewLight) {
    LightSlots slots;
    update(slots, Lights().add(1, 1).add(2, 2), 0);
    update(slots, Lights().add(2, 2), 1);
    update(slots, Lights().add(1, 1).add(2, 2), 2);
    EXPECT_EQ(slots.slotOf(1), 2u);
    EXPECT_EQ(slots.slotOf(2), 1u);
    EXPECT_TRUE(hasFlag(slots, 0, LIGHT_FLAG_DEAD));
    EXPECT_EQ(slots.fresh(), std::vector<std::uint32_t>{2});
}

TEST(LightSlots, FreshAreTheStrongestLocalOnesThatShine) {
    LightSlots slots;
    Lights before, after;
    for (std::uint64_t id = 1; id <= 12; ++id) {
        before.add(id, 1.0f);
        after.add(id, float(id * 5 % 13), id == 4 ? LIGHT_SPHERE | LIGHT_FLAG_MUTED : LIGHT_SPHERE);
    }
    before.add(13, 1.0f, LIGHT_DIRECTIONAL);
    after.add(13, 100.0f, LIGHT_DIRECTIONAL);
    update(slots, before, 0);
    update(slots, after, 1);
    // Intensities of slots 0 to 11: 5 10 2 7(muted) 12 4 9 1 6 11 3 8.
    EXPECT_EQ(slots.fresh(), (std::vector<std::uint32_t>{0, 1, 4, 5, 6, 8, 9, 11}));
    EXPECT_EQ(slots.fresh().size(), FRESH_LIGHTS);
    EXPECT_EQ(slots.directional(), std::vector<std::uint32_t>{12});
}

} // namespace
} // namespace kilolux
