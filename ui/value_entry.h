// What a person types into a number field: '800 lm', '2.5k cd', '50 cm', '30 deg', '1/2', '*2', '+10 %'. Text
// in, a way to change numbers out; and numbers to text that reads back as the same number.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace kilolux {

// What a field holds. Lengths are metres and angles radians inside; people read and type angles in degrees.
enum class Quantity : std::uint8_t { Number, Intensity, Length, Angle, Temperature, Exposure };

struct ValueEntry {
    enum class How : std::uint8_t { Set, Add, Multiply, Clear } how = How::Set;
    double value = 0.0;            // metres, radians, kelvin, EV; intensities in `unit`; a plain factor
    std::optional<LightUnit> unit; // of an intensity, when it was typed
};

// A bare number is in the unit that the field shows. A leading '+', '+=', '-=', '*' or '/' changes what is
// there, a leading '-' is a negative number; 'N %' is a share of it and '+N %' or '-N %' are on top of it.
// 'none' and 'auto' clear. Errors say what was expected and quote the text.
Result<ValueEntry> parseEntry(std::string_view text, Quantity quantity);

// What the entry makes of a number. Intensities that differ in unit are for withIntensity().
double changed(double before, const ValueEntry& entry);

// The light's intensity and unit after the entry. A typed unit stays; an offset in another unit, and a factor
// on a logarithmic one, change the light that is emitted, in the unit that the light has. Errors: the unit
// does not suit it.
struct TypedIntensity {
    double value = 0.0;
    LightUnit unit = LightUnit::Candela;
};
Result<TypedIntensity> withIntensity(const LightDef& def, const ValueEntry& entry);

// At most `digits` significant digits, without trailing zeros; angles in degrees.
std::string formatQuantity(double value, Quantity quantity, int digits = 6);

// The unit behind such a number: "m", "\u00b0", "lm"; empty for plain numbers.
std::string_view unitLabel(Quantity quantity, LightUnit unit = LightUnit::Candela);

} // namespace kilolux
