// What the probe panel remembers; see panels.h.
#pragma once

#include "ui/pixel_probe.h"

namespace kilolux {

struct Desk;

struct ProbeState {
    PixelProbe probe;
    std::optional<glm::ivec2> pixel; // of the picture; nothing: not chosen yet
    bool picking = false;            // a click in the viewport chooses a pixel
    bool pressed = false;            // it holds the pointer
    std::uint64_t askedFrame = 0;    // picture that it was asked of last
    double askedS = 0.0;
};

void toggleProbe(Desk& desk);     // the next click chooses a pixel, or no longer
bool cancelProbePick(Desk& desk); // no longer; false: it did not anyway

// Light of a line from the probed point: 0 hidden, 1 wholly visible.
struct ProbeLine {
    glm::dvec3 fromWs{0.0}, toWs{0.0};
    bool visible = false;
    std::uint64_t light = 0; // LightNode::id
};
// A few lines to each light in range, those that give most light last, so that they lie on top.
std::vector<ProbeLine> probeLines(const Probe& probe, int perLight);

} // namespace kilolux
