// Handles of lights: where their dots stand, and that a dot follows the pointer to the value that it shows.
#include "ui/light_handles.h"

#include "renderer/document/light_properties.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace kilolux {
namespace {

Viewport viewportAt(const glm::dvec3& eyeWs, const glm::dvec3& targetWs) {
    Viewport viewport;
    viewport.rect = {100, 50, 800, 600};
    const glm::dvec3 z = glm::normalize(eyeWs - targetWs);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z)), y = glm::cross(z, x);
    viewport.camera.worldFromCamera =
        glm::dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(eyeWs, 1));
    return viewport;
}

LightDef doored() {
    LightDef def;
    def.type = LightType::Rect;
    def.widthM = 1.2;
    def.heightM = 0.8;
    def.rangeM = 3.0;
    def.barnDoors.fill({0.6, 0.4});
    return def;
}

HandleFrame frame() {
    return {glm::dvec3(0.3, 1.0, -0.2), glm::dmat3(1.0), 0.05, 0.5};
}

TEST(LightHandles, EveryTypeHasThoseOfItsNumbers) {
    const std::map<LightType, std::set<std::string>> wanted = {
        {LightType::Directional, {}},
        {LightType::Sphere, {"radiusM", "rangeM"}},
        {LightType::Spot, {"radiusM", "outerConeRad", "innerConeRad", "rangeM"}},
        {LightType::Tube, {"radiusM", "lengthM", "rangeM"}},
        {LightType::Disk, {"widthM", "rangeM"}},
        {LightType::Rect,
         {"widthM", "heightM", "rangeM", "barnDoorLeftAngleRad", "barnDoorLeftLengthM",
          "barnDoorRightAngleRad", "barnDoorRightLengthM", "barnDoorTopAngleRad", "barnDoorTopLengthM",
          "barnDoorBottomAngleRad", "barnDoorBottomLengthM"}}};
    for (const auto& [type, fields] : wanted) {
        LightDef def = doored();
        def.type = type;
        std::set<std::string> found;
        for (const LightHandle& handle : handlesOf(def, frame(), DoorNumbers::FourFlaps)) {
            found.insert(handle.field);
            EXPECT_NE(rowOf(handle.field, type).types & typeBit(type), 0u) << handle.field;
        }
        EXPECT_EQ(found, fields);
    }
}

// One pair of numbers has one pair of dots, which move as those of the flap that they stand at.
TEST(LightHandles, OnePairOfDoorsHasOnePairOfDots) {
    const LightDef def = doored();
    std::map<std::string, LightHandle> pair, flaps;
    for (const LightHandle& handle : handlesOf(def, frame(), DoorNumbers::OnePair))
        pair.emplace(handle.field, handle);
    for (const LightHandle& handle : handlesOf(def, frame(), DoorNumbers::FourFlaps))
        flaps.emplace(handle.field, handle);
    EXPECT_EQ(pair.size() + 6, flaps.size());
    EXPECT_EQ(pair.at("barnDoorAngleRad").pointAt(0.2), flaps.at("barnDoorTopAngleRad").pointAt(0.2));
    EXPECT_EQ(pair.at("barnDoorLengthM").pointAt(0.7), flaps.at("barnDoorTopLengthM").pointAt(0.7));
    for (const auto& [field, handle] : pair)
        EXPECT_EQ(rowOf(field, def.type).field, field);
}

// Dragged to where the dot of another value would be, a handle asks for that value; from anywhere on the dot.
TEST(LightHandles, ADragEndsAtTheValueUnderThePointer) {
    for (const LightType type :
         {LightType::Sphere, LightType::Spot, LightType::Tube, LightType::Rect, LightType::Disk}) {
        LightDef def = doored();
        def.type = type;
        def.radiusM = 0.1;
        def.lengthM = 0.7;
        def.innerConeRad = 0.2;
        def.outerConeRad = 0.5;
        const Viewport viewport = viewportAt({2.6, 2.3, 3.1}, {0.3, 1.0, -0.2});
        for (const LightHandle& handle : handlesOf(def, frame(), DoorNumbers::FourFlaps)) {
            const double wanted = handle.isArc ? handle.value + 0.25 : 1.5 * handle.value + 0.1;
            const auto from = viewport.project(handle.pointWs()),
                       to = viewport.project(handle.pointAt(wanted));
            ASSERT_TRUE(from && to) << handle.field;
            const glm::dvec2 beside(3.0, -2.0);
            const HandleDrag drag(handle, viewport, *from + beside);
            EXPECT_NEAR(drag.to(viewport, *from + beside, 0.0), handle.value, 2e-3) << handle.field;
            EXPECT_NEAR(drag.to(viewport, *to + beside, 0.0), wanted, 2e-3 * (1.0 + wanted)) << handle.field;
            const double step = handle.isArc ? glm::radians(5.0) : 0.1;
            const double snapped = drag.to(viewport, *to + beside, step);
            EXPECT_NEAR(snapped / step, std::round(snapped / step), 1e-9) << handle.field;
        }
    }
}

// Seen along the beam an arc is a line: it still follows, and nothing is a number that is none.
TEST(LightHandles, ViewsFromTheEdgeGiveNumbers) {
    LightDef def = doored();
    def.type = LightType::Spot;
    for (const glm::dvec3& eye :
         {glm::dvec3(0.3, 1.0, 4.0), glm::dvec3(0.3, 5.0, -0.19), glm::dvec3(5.0, 1.0, -0.2)}) {
        const Viewport viewport = viewportAt(eye, {0.3, 1.0, -0.2});
        for (const LightHandle& handle : handlesOf(def, frame(), DoorNumbers::FourFlaps)) {
            const auto dot = viewport.project(handle.pointWs());
            if (!dot) continue;
            const HandleDrag drag(handle, viewport, *dot);
            for (const glm::dvec2& px : {glm::dvec2(120, 70), glm::dvec2(500, 350), glm::dvec2(2000, -400)})
                EXPECT_TRUE(std::isfinite(drag.to(viewport, px, 0.0))) << handle.field;
        }
    }
}

TEST(LightHandles, TheNearestWithinReachIsTaken) {
    const Viewport viewport = viewportAt({2.6, 2.3, 3.1}, {0.3, 1.0, -0.2});
    const std::vector<LightHandle> handles = handlesOf(doored(), frame(), DoorNumbers::FourFlaps);
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const auto dot = viewport.project(handles[i].pointWs());
        ASSERT_TRUE(dot);
        EXPECT_EQ(handleAt(handles, viewport, *dot, 9.0), int(i)) << handles[i].field;
    }
    EXPECT_EQ(handleAt(handles, viewport, {-500, -500}, 9.0), -1);
}

} // namespace
} // namespace kilolux
