// What can be seen and changed of one or several lights: a table of fields, their common values, and the
// edits that a typed or dragged value makes. Adding a row to the table adds a line to the properties panel.
#pragma once

#include "renderer/document/edit_build.h"
#include "ui/value_entry.h"

#include <span>

namespace kilolux {

enum class LightSection : std::uint8_t {
    Light,
    Shape,
    Shaping,
    Profile,
    Function,
    Colour,
    Shadow,
    Visibility
};

struct LightField {
    LightSection section;
    const char* label;
    const char* field;   // of edit_fields
    Quantity quantity;   // of a number
    std::uint32_t types; // bits 1 << LightType that have it
    double step;         // what one pixel of dragging adds, as inside; 0: one pixel is a factor
    const char* help;
    bool (*shows)(const LightDef&) = nullptr; // only where this holds; null: always
};
std::span<const LightField> lightFields();

// Barn doors have two numbers for all four flaps, or two for each.
enum class DoorNumbers : std::uint8_t { OnePair, FourFlaps };
std::optional<DoorNumbers> doorNumbersOf(const LightField& field); // absent: none of doors
// Whether one pair of numbers says all there is about the flaps of these lights.
bool doorsAreEven(const Scene& scene, std::span<const std::uint64_t> lights);

// Whether all these lights have the field, and it does something there.
bool allHave(const Scene& scene, std::span<const std::uint64_t> lights, const LightField& field);

// What several lights have in a field: one value, or different ones.
struct CommonValue {
    EditValue value; // of the first light
    bool mixed = false;
};
CommonValue commonValue(const Scene& scene, std::span<const std::uint64_t> lights, std::string_view field);

// --- edits. `lights` are ids that exist, sorted. Where all lights that share a definition are among them, it
// is edited once and stays shared.

// `from`: the document whose numbers the entry changes, for drags the one at their start. Clamping keeps
// dragged numbers within what the field can hold, where a typed one is refused.
enum class OutOfRange { Refuse, Clamp };
Result<Edits> editsForEntry(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                            const LightField& field, const ValueEntry& entry, Sharing sharing,
                            OutOfRange outOfRange = OutOfRange::Refuse);

// Scales the sizes of sources along their own axes: the width and length of a light are its X, the height its
// Y; what is round takes any. From the sizes that `from` has. A point has no size: no edits.
Result<Edits> editsForSize(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                           const glm::dvec3& factors, Sharing sharing);

// Any other field of lights or their definitions.
Result<Edits> editsForValue(const Scene& scene, std::span<const std::uint64_t> lights, std::string_view field,
                            const EditValue& value, Sharing sharing);

// Makes the flaps of each light alike, as its longest one.
Result<Edits> editsForEvenDoors(const Scene& scene, std::span<const std::uint64_t> lights, Sharing sharing);

// Several lights get the name with numbers behind it.
Result<Edits> editsForName(const Scene& scene, std::span<const std::uint64_t> lights,
                           const std::string& name);

// How many lights besides `lights` show a definition of theirs.
int othersSharing(const Scene& scene, std::span<const std::uint64_t> lights);

// '#rrggbb' (sRGB), three numbers from 0 up (linear), or one for a grey.
Result<glm::dvec3> parseColor(std::string_view text);
std::string formatColor(const glm::dvec3& linear); // three numbers
glm::dvec3 srgbFromLinear(const glm::dvec3& linear);
glm::dvec3 linearFromSrgb(const glm::dvec3& srgb);

} // namespace kilolux
