// What a person does to lights as a whole: adding one where the pointer is, duplicating, deleting, muting,
// grouping, copying as text. Each makes the edits of one named change; nothing here changes the document.
#pragma once

#include "renderer/document/edit_build.h"

#include <glm/glm.hpp>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace kilolux {

// --- names

std::string_view typeName(LightType type);    // "Sphere light"
std::string countedLights(std::size_t count); // "1 light", "3 lights"

// Gives names that no light of the scene has: 'Lamp', 'Lamp 2', 'Lamp 3'. Each is given once.
class FreeNames {
  public:
    explicit FreeNames(const Scene& scene);
    explicit FreeNames(std::set<std::string, std::less<>> taken) : taken_(std::move(taken)) {}
    std::string take(std::string base);

  private:
    std::set<std::string, std::less<>> taken_;
    std::map<std::string, int, std::less<>> next_; // number to try next, by base
};

// --- making lights. Those made are told by newLights().

// Where a light is put: a surface, or a point in the air, and the direction that it looks.
struct LightPlace {
    glm::dvec3 pointWs{0.0};
    glm::dvec3 dirWs{0.0, -1.0, 0.0}; // unit length
};
// A light of the type with a size and intensity to begin with, hanging a little off the point.
LightDef defaultLight(LightType type);
Edits addLightAt(const Scene& scene, EditIds& ids, LightType type, const LightPlace& place);
Result<Edits> duplicateLights(const Scene& scene, EditIds& ids, std::span<const std::uint64_t> lights);

// Ids of the lights that the edits make, sorted.
std::vector<std::uint64_t> newLights(std::span<const Edit> edits);

// --- changing many

Result<Edits> deleteLights(const Scene& scene, std::span<const std::uint64_t> lights);
// Mutes all of them, or switches all on when all are muted.
bool allMuted(const Scene& scene, std::span<const std::uint64_t> lights);
Result<Edits> muteLights(const Scene& scene, std::span<const std::uint64_t> lights, bool muted);
Result<Edits> makeLightsUnique(const Scene& scene, std::span<const std::uint64_t> lights);

// --- groups

// A new group of these lights under a free name that begins with `base`.
Result<Edits> groupLights(const Scene& scene, EditIds& ids, std::span<const std::uint64_t> lights,
                          std::string base);
Result<Edits> assignGroup(const Scene& scene, std::span<const std::uint64_t> lights, std::uint64_t group);
// Their lights stay, in no group.
Result<Edits> deleteGroups(const Scene& scene, std::span<const std::uint64_t> groups);
std::vector<std::uint64_t> membersOf(const Scene& scene, std::uint64_t group); // sorted

// --- lights as text: one JSON object a line, which another window can take as well

std::string lightsToText(const Scene& scene, std::span<const std::uint64_t> lights);
// The edits that make the lights of a text at the places where they were; groups are found by name or made.
// Errors say that the text holds no lights, or name the line and what was expected.
Result<Edits> lightsFromText(const Scene& scene, EditIds& ids, std::string_view text);

// --- solo: the document as it is rendered while only some lights shine. A view, not an edit.
Scene withSolo(const Scene& scene, std::span<const std::uint64_t> lights);

} // namespace kilolux
