// The probe: why a pixel looks as it does. Its surface, every light with weight, probability, visibility and
// energy, and how the frame chose among them; as a struct, and as JSON (kilolux probe).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace kilolux {

enum class ProbeDepth { Surface, Lights }; // Surface: without lights, for what follows the pointer

struct ProbeRay {
    glm::dvec3 pointWs{0.0}; // on the light; metres, world
    bool visible = false;
};

struct ProbedLight {
    std::uint64_t id = 0; // LightNode::id; kDomeLightId (gpu_lights.h) of the dome
    std::uint32_t slot = 0;
    std::string name, type;
    bool reaches = false;       // on, and the pixel lies within its range, its cone and on its side
    bool inCell = false;        // on the grid cell's list
    bool listed = false;        // on the visible list that guided this pixel
    bool fresh = false;         // just edited
    bool candidate = false;     // weighed in this frame; only these can be chosen in it
    std::string list;           // "visible", "hidden", "directional" or "dome", of a candidate
    std::uint32_t areaMask = 0; // cells of 4 x 4 of the light that were seen, 16 bits; of a listed one
    std::uint32_t unseenFrames = 0;
    double weight = 0.0;             // perceptual: log2(1 + exposed luminance), estimated without shadows
    double probability = 0.0;        // that a sample of this frame goes to it
    std::uint32_t chosen = 0;        // samples of this frame that did
    std::uint32_t chosenVisible = 0; // and met it; not known at half resolution
    double visibility = 0.0;         // share of the probe's rays that met it; 0 without rays
    glm::dvec3 irradianceLux{0.0};   // on the surface, analytic, without shadows
    glm::dvec3 reflectedNit{0.0};    // towards the camera, the same
    double lux = 0.0;                // luminance of both, with the visibility
    double nit = 0.0;
    double share = 0.0; // of the nit of all lights
    std::vector<ProbeRay> rays;
};

struct Probe {
    glm::ivec2 pixel{0};    // of the picture
    glm::ivec2 choosing{0}; // rendered pixel that chose the lights: at half resolution it may be a neighbour
    bool surface = false;   // else the sky, and nothing of what follows but the picture
    glm::dvec3 pictureNit{0.0}; // linear Rec. 709
    glm::dvec3 viewValue{0.0};  // raw value of the view
    std::string view;
    double exposureEv100 = 0.0;
    double stops = 0.0; // of the picture's luminance from middle grey
    double depthM = 0.0;
    glm::dvec3 positionWs{0.0}, normalWs{0.0}, geometricNormalWs{0.0}, viewDirWs{0.0};
    glm::dvec3 baseColor{0.0};
    double roughness = 0.0, metallic = 0.0;
    std::string node, mesh, material; // that the pixel shows
    std::uint32_t instance = 0, triangle = 0;
    double illuminanceLux = 0.0; // as the frame found it
    // Of the stochastic method; 0 for others.
    bool hasTurn = true; // below one ray per pixel it may be another pixel's turn
    bool missed = false; // not found in the previous frame
    std::uint32_t candidates = 0, cellLights = 0, stride = 0, listLights = 0;
    glm::ivec2 listTile{0};
    double visibleWeight = 0.0, hiddenWeight = 0.0, directionalWeight = 0.0; // sums
    double domeWeight = 0.0;
    double hiddenBudget = 0.0, directionalBudget = 0.0,
           domeBudget = 0.0; // what those but the first count for
    // Of all lights.
    std::uint32_t lightsInRange = 0, lightsSeen = 0;
    double lux = 0.0, nit = 0.0;     // with shadows, by the probe's own rays
    double effectiveLights = 0.0;    // (sum of nit)^2 / sum of nit^2
    std::vector<ProbedLight> lights; // those in range, listed or weighed; most nit first
};

// Names as above; of lights `energy` { irradianceLux, reflectedNit, lux, nit, share }.
nlohmann::ordered_json probeJson(const Probe& probe);

} // namespace kilolux
