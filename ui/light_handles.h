// Dots that change one number of a light where it is seen: range, cone angles, sizes, barn doors. Where they
// stand, and which number the pointer asks for. In pixels of the window and metres of the scene; draws
// nothing.
#pragma once

#include "ui/light_fields.h"
#include "ui/viewport.h"

#include <span>
#include <vector>

namespace kilolux {

// The light that the handles are of.
struct HandleFrame {
    glm::dvec3 centerWs{0.0};
    glm::dmat3 axes{1.0}; // columns, unit length; the light looks along -Z
    double gapM = 0.0;    // how far beside its edge a dot stands
    double coneM = 1.0;   // how long the cone is drawn
};

// A number and the path that its dot moves along: a line, or an arc about a centre.
struct LightHandle {
    const char* field; // of lightFields()
    double value = 0.0;
    std::uint64_t light = 0; // whose it is, for who shows several
    bool isArc = false;
    glm::dvec3 originWs{0.0};
    // Line: where value 0 is, and what a unit of the value moves by. Arc: `along` where the angle is 0 and
    // `across` where it is pi/2, both as long as the radius.
    glm::dvec3 alongWs{0.0}, acrossWs{0.0};
    double least = 0.0, most = 1e9; // what the path is searched for

    glm::dvec3 pointAt(double v) const;
    glm::dvec3 pointWs() const { return pointAt(value); }
};

// With one pair of numbers for all flaps of the doors their dots stand at the upper one.
std::vector<LightHandle> handlesOf(const LightDef& def, const HandleFrame& frame, DoorNumbers doors);

// The handle within reach of the pointer, the nearest; -1: none.
int handleAt(std::span<const LightHandle> handles, const Viewport& viewport, glm::dvec2 px, double reachPx);

class HandleDrag {
  public:
    HandleDrag(const LightHandle& handle, const Viewport& viewport, glm::dvec2 startPx);

    // The number under the pointer, as far from it as at the start. `step`: 0, or what it snaps to.
    double to(const Viewport& viewport, glm::dvec2 px, double step) const;
    const LightHandle& handle() const { return handle_; }

  private:
    LightHandle handle_;
    glm::dvec2 offsetPx_{0.0}; // from the pointer to the dot
};

// The row of a field on such a light; the table has one for each handle.
const LightField& rowOf(std::string_view field, LightType type);

} // namespace kilolux
