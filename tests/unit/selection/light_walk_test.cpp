// The walk over visible list, fresh list and grid cell: each light once, in order, with the right membership.
#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace kilolux::test {
namespace walk {

using namespace glm;
using uint = std::uint32_t;

static std::vector<uint> gVisible;
static std::vector<uint> gFresh;
static std::vector<uint> gCell;
static uint fetchVisibleLight(uint at) {
    return gVisible.at(at);
}
static uint fetchFreshLight(uint at) {
    return gFresh.at(at);
}
static uint fetchCellLight(uint at) {
    return gCell.at(at);
}

#define float double
#include "shaders/math/light_walk.glsl"
#undef float

} // namespace walk

namespace {

using walk::uint;

struct Visit {
    uint slot;
    bool visible;
    uint visibleEntry;
};

std::vector<Visit> visits(uint stride, uint offset) {
    std::vector<Visit> all;
    walk::LightWalk w = walk::beginWalk(uint(walk::gVisible.size()), uint(walk::gFresh.size()),
                                        uint(walk::gCell.size()), stride, offset);
    while (walk::nextLight(w)) {
        all.push_back({w.slot, w.visible, w.visibleEntry});
        if (all.size() > 10000) ADD_FAILURE() << "no end";
        if (all.size() > 10000) break;
    }
    EXPECT_FALSE(walk::nextLight(w)) << "an ended walk stays ended";
    return all;
}

// Entries above all before them: what a list counts for.
std::set<uint> effective(const std::vector<uint>& list) {
    std::set<uint> slots;
    for (const uint slot : list)
        if (slot != walk::KX_NO_LIGHT && (slots.empty() || slot > *slots.rbegin())) slots.insert(slot);
    return slots;
}

// All offsets of one stride: every light of a list once per offset as visible, every other light of the cell
// once over all offsets as hidden.
void expectEachOnce(uint stride, const char* what) {
    std::set<uint> visible = effective(walk::gVisible);
    visible.merge(effective(walk::gFresh));
    std::map<uint, uint> hiddenVisits;
    for (uint offset = 0; offset < stride; ++offset) {
        std::set<uint> seen;
        uint last = 0;
        for (const Visit& visit : visits(stride, offset)) {
            ASSERT_TRUE(seen.insert(visit.slot).second) << what << ": " << visit.slot << " twice";
            ASSERT_TRUE(seen.size() == 1 || visit.slot > last) << what << ": out of order";
            last = visit.slot;
            ASSERT_EQ(visit.visible, visible.count(visit.slot) == 1) << what << ": " << visit.slot;
            const bool onVisible = effective(walk::gVisible).count(visit.slot) == 1;
            ASSERT_EQ(visit.visibleEntry != walk::KX_NO_LIGHT, onVisible) << what;
            if (onVisible) {
                ASSERT_EQ(walk::gVisible.at(visit.visibleEntry), visit.slot) << what;
            }
            if (!visit.visible) ++hiddenVisits[visit.slot];
        }
        for (const uint slot : visible)
            ASSERT_TRUE(seen.count(slot) == 1) << what << ": listed " << slot << " not visited";
    }
    uint hiddenLights = 0;
    for (const uint slot : effective(walk::gCell)) {
        if (visible.count(slot) == 1) continue;
        ++hiddenLights;
        ASSERT_EQ(hiddenVisits[slot], 1u) << what << ": " << slot << " of the cell, stride " << stride;
    }
    ASSERT_EQ(hiddenVisits.size(), hiddenLights) << what;
}

std::vector<uint> randomList(std::mt19937& random, uint most, uint slots) {
    std::vector<uint> list(random() % (most + 1));
    for (uint& slot : list)
        slot = static_cast<uint>(random() % slots);
    return list;
}

void sortUnique(std::vector<uint>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

TEST(LightWalk, PlainLists) {
    walk::gVisible = {3, 7, 9};
    walk::gFresh = {};
    walk::gCell = {1, 3, 5, 9, 12};
    const std::vector<Visit> all = visits(2, 0); // of the cell 1, 5, 12
    const std::vector<Visit> expected = {{1, false, walk::KX_NO_LIGHT},
                                         {3, true, 0},
                                         {5, false, walk::KX_NO_LIGHT},
                                         {7, true, 1},
                                         {9, true, 2},
                                         {12, false, walk::KX_NO_LIGHT}};
    ASSERT_EQ(all.size(), expected.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].slot, expected[i].slot);
        EXPECT_EQ(all[i].visible, expected[i].visible);
        EXPECT_EQ(all[i].visibleEntry, expected[i].visibleEntry);
    }
}

TEST(LightWalk, EmptyEqualAndDisjointLists) {
    const std::vector<uint> list = {0, 2, 4, 6, 8};
    const std::vector<uint> other = {1, 3, 5, 7};
    for (const auto& visible : {std::vector<uint>{}, list, other})
        for (const auto& fresh : {std::vector<uint>{}, list, other})
            for (const auto& cell : {std::vector<uint>{}, list, other})
                for (uint stride = 1; stride < 8; ++stride) {
                    walk::gVisible = visible;
                    walk::gFresh = fresh;
                    walk::gCell = cell;
                    expectEachOnce(stride, "empty, equal, disjoint");
                }
}

TEST(LightWalk, FuzzedLists) {
    std::mt19937 random(1);
    for (int round = 0; round < 4000; ++round) {
        const uint slots = round % 3 == 0 ? 12 : 200;
        walk::gVisible = randomList(random, 20, slots);
        walk::gFresh = randomList(random, 8, slots);
        walk::gCell = randomList(random, 60, slots);
        std::sort(walk::gFresh.begin(), walk::gFresh.end());
        sortUnique(walk::gCell); // as the grid builds it
        const int kind = round % 4;
        if (kind == 0) sortUnique(walk::gVisible);
        if (kind == 1) std::sort(walk::gVisible.begin(), walk::gVisible.end()); // with duplicates
        if (kind == 3)                                                          // with empty entries
            for (std::size_t i = 0; i < walk::gVisible.size(); i += 3)
                walk::gVisible[i] = walk::KX_NO_LIGHT;
        expectEachOnce(1 + static_cast<uint>(random() % 9), "fuzzed");
        if (HasFatalFailure()) return;
    }
}

// Without a stride even a cell with duplicates, or out of order, gives each light at most once.
TEST(LightWalk, BrokenCellNeverRepeatsALight) {
    std::mt19937 random(2);
    for (int round = 0; round < 2000; ++round) {
        walk::gVisible = randomList(random, 10, 30);
        walk::gFresh = randomList(random, 4, 30);
        walk::gCell = randomList(random, 40, 30);
        std::set<uint> seen;
        for (const Visit& visit : visits(1 + round % 3, 0))
            ASSERT_TRUE(seen.insert(visit.slot).second);
    }
}

} // namespace
} // namespace kilolux::test
