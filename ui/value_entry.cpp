// A small expression parser with units. Every value carries whether it is a plain number or an amount of the
// field's quantity, so that '2 * 50 cm' is a length and '1 m + 2' is refused.
#include "ui/value_entry.h"

#include "renderer/document/light_units.h"
#include "ui/text_case.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace kilolux {

namespace {

struct UnitWord {
    std::string_view word;
    Quantity quantity;
    double factor; // to the unit inside
    LightUnit unit = LightUnit::Candela;
};

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Longer words stand before those they begin with.
constexpr UnitWord kUnits[] = {
    {"lumens", Quantity::Intensity, 1.0, LightUnit::Lumen},
    {"lumen", Quantity::Intensity, 1.0, LightUnit::Lumen},
    {"lm", Quantity::Intensity, 1.0, LightUnit::Lumen},
    {"candela", Quantity::Intensity, 1.0, LightUnit::Candela},
    {"cd/m2", Quantity::Intensity, 1.0, LightUnit::Nit},
    {"cd/m\u00b2", Quantity::Intensity, 1.0, LightUnit::Nit},
    {"cd", Quantity::Intensity, 1.0, LightUnit::Candela},
    {"lux", Quantity::Intensity, 1.0, LightUnit::Lux},
    {"lx", Quantity::Intensity, 1.0, LightUnit::Lux},
    {"nits", Quantity::Intensity, 1.0, LightUnit::Nit},
    {"nit", Quantity::Intensity, 1.0, LightUnit::Nit},
    {"ev100", Quantity::Intensity, 1.0, LightUnit::Ev100},
    {"ev", Quantity::Intensity, 1.0, LightUnit::Ev100},
    {"mm", Quantity::Length, 0.001},
    {"cm", Quantity::Length, 0.01},
    {"km", Quantity::Length, 1000.0},
    {"m", Quantity::Length, 1.0},
    {"in", Quantity::Length, 0.0254},
    {"ft", Quantity::Length, 0.3048},
    {"degrees", Quantity::Angle, kDegree},
    {"deg", Quantity::Angle, kDegree},
    {"\u00b0", Quantity::Angle, kDegree},
    {"rad", Quantity::Angle, 1.0},
    {"kelvin", Quantity::Temperature, 1.0},
    {"K", Quantity::Temperature, 1.0},
    {"ev100", Quantity::Exposure, 1.0},
    {"ev", Quantity::Exposure, 1.0},
    {"stops", Quantity::Exposure, 1.0},
};

double factorOfBareNumber(Quantity quantity) {
    return quantity == Quantity::Angle ? kDegree : 1.0;
}

const char* exampleOf(Quantity quantity) {
    switch (quantity) {
    case Quantity::Number:
        return "a number such as '0.5' or '*2'";
    case Quantity::Intensity:
        return "an intensity such as '800 lm', '2.5k cd' or '*2'";
    case Quantity::Length:
        return "a length such as '50 cm' or '1.2 m'";
    case Quantity::Angle:
        return "an angle such as '30' or '30 deg'";
    case Quantity::Temperature:
        return "a temperature such as '2700 K'";
    case Quantity::Exposure:
        return "an exposure such as '8' or '+1'";
    }
    return "";
}

bool isSpace(char c) {
    return c == ' ' || c == '\t';
}
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
// Bytes of words: letters, and what UTF-8 writes signs with.
bool isLetter(char c) {
    return (lowered(c) >= 'a' && lowered(c) <= 'z') || static_cast<unsigned char>(c) >= 0x80;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return text;
}

// A number, or an amount of the quantity (dimension 1).
struct Amount {
    double value = 0.0;
    int dimension = 0;
    double factor = 1.0; // of the unit that it was typed with
};

class Parser {
  public:
    Parser(std::string_view text, Quantity quantity) : rest_(text), quantity_(quantity) {}

    // The whole text as one expression; nothing when it is none.
    std::optional<Amount> parse() {
        std::optional<Amount> amount = sum();
        skipSpace();
        if (!amount || !rest_.empty() || !std::isfinite(amount->value)) return std::nullopt;
        return amount;
    }
    std::optional<LightUnit> unit() const { return unit_; }

  private:
    static constexpr int kMaxDepth = 50;

    void skipSpace() { rest_ = rest_.substr(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }
    bool take(char c) {
        skipSpace();
        if (rest_.empty() || rest_.front() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }

    std::optional<Amount> sum() {
        std::optional<Amount> left = product();
        while (left) {
            const bool plus = take('+');
            if (!plus && !take('-')) break;
            const std::optional<Amount> right = product();
            if (!right || right->dimension != left->dimension) return std::nullopt;
            left->value += plus ? right->value : -right->value;
        }
        return left;
    }

    std::optional<Amount> product() {
        std::optional<Amount> left = atom();
        while (left) {
            const bool times = take('*');
            if (!times && !take('/')) break;
            const std::optional<Amount> right = atom();
            if (!right) return std::nullopt;
            if (!times && left->dimension == 0 && right->dimension == 1) {
                // '1/2 m' is half a metre, as people mean it.
                *left = {left->value / (right->value / right->factor) * right->factor, 1, right->factor};
                continue;
            }
            left->value = times ? left->value * right->value : left->value / right->value;
            left->dimension += times ? right->dimension : -right->dimension;
            if (left->dimension < 0 || left->dimension > 1) return std::nullopt;
        }
        return left;
    }

    std::optional<Amount> atom() {
        if (++depth_ > kMaxDepth) return std::nullopt;
        std::optional<Amount> amount;
        if (take('-')) {
            amount = atom();
            if (amount) amount->value = -amount->value;
        } else if (take('(')) {
            amount = sum();
            if (!take(')')) return std::nullopt;
        } else {
            amount = number();
        }
        --depth_;
        return amount && withUnit(*amount) ? amount : std::nullopt;
    }

    std::optional<Amount> number() {
        skipSpace();
        // from_chars knows words such as 'inf' as well.
        if (rest_.empty() || !(isDigit(rest_.front()) || rest_.front() == '.')) return std::nullopt;
        Amount amount;
        const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), amount.value);
        if (read.ec != std::errc()) return std::nullopt;
        rest_.remove_prefix(std::size_t(read.ptr - rest_.data()));
        return amount;
    }

    const UnitWord* unitAt(std::string_view text) const {
        for (const UnitWord& unit : kUnits) {
            if (unit.quantity != quantity_ || text.size() < unit.word.size()) continue;
            const bool same = std::equal(unit.word.begin(), unit.word.end(), text.begin(),
                                         [](char a, char b) { return lowered(a) == lowered(b); });
            // A small k is a thousand.
            if (unit.word == "K" && text.front() != 'K') continue;
            // Not the beginning of a longer word.
            if (same && (text.size() == unit.word.size() || !isLetter(text[unit.word.size()]))) return &unit;
        }
        return nullptr;
    }

    // Takes 'k' or 'M' and a unit behind a number, where there are any; false when a word is neither.
    bool withUnit(Amount& amount) {
        skipSpace();
        if (rest_.empty() || !isLetter(rest_.front())) return true;
        const UnitWord* unit = unitAt(rest_);
        const bool thousands = lowered(rest_.front()) == 'k', millions = rest_.front() == 'M';
        if (!unit && (thousands || millions)) {
            std::string_view behind = rest_.substr(1);
            const bool endsHere = behind.empty() || !isLetter(behind.front());
            behind = trimmed(behind);
            unit = unitAt(behind);
            if (!unit && !endsHere) return false;
            amount.value *= thousands ? 1e3 : 1e6;
            rest_ = behind;
            if (!unit) return behind.empty() || !isLetter(behind.front());
        }
        if (!unit || amount.dimension != 0) return false;
        if (quantity_ == Quantity::Intensity) {
            if (unit_ && *unit_ != unit->unit) return false;
            unit_ = unit->unit;
        }
        amount.value *= unit->factor;
        amount.dimension = 1;
        amount.factor = unit->factor;
        rest_.remove_prefix(unit->word.size());
        return true;
    }

    std::string_view rest_;
    Quantity quantity_;
    std::optional<LightUnit> unit_;
    int depth_ = 0;
};

// What stands before the expression.
ValueEntry::How takeOperator(std::string_view& text, double& sign, bool& byPercentSign) {
    using How = ValueEntry::How;
    sign = 1.0;
    byPercentSign = false;
    const char first = text.empty() ? '\0' : text.front();
    const bool assigns = text.size() > 1 && text[1] == '=';
    if (first == '+' || (first == '-' && assigns)) {
        sign = first == '-' ? -1.0 : 1.0;
        byPercentSign = true;
        text.remove_prefix(assigns ? 2 : 1);
        return How::Add;
    }
    if (first == '*' || first == '/') {
        sign = first == '/' ? -1.0 : 1.0;
        text.remove_prefix(assigns ? 2 : 1);
        return How::Multiply;
    }
    return How::Set;
}

} // namespace

Result<ValueEntry> parseEntry(std::string_view typed, Quantity quantity) {
    using How = ValueEntry::How;
    const auto refuse = [&] {
        constexpr std::size_t kQuoted = 40;
        const std::string_view quoted = typed.substr(0, kQuoted);
        return Error{fmt::format("expected {}, found '{}{}'", exampleOf(quantity), quoted,
                                 typed.size() > kQuoted ? "..." : "")};
    };
    std::string_view text = trimmed(typed);
    ValueEntry entry;
    if (text == "none" || text == "auto") {
        entry.how = How::Clear;
        return entry;
    }
    double sign = 1.0;
    bool onTop = false;
    entry.how = takeOperator(text, sign, onTop);
    const bool percent = !text.empty() && text.back() == '%';
    if (percent) {
        text.remove_suffix(1);
        if (entry.how == How::Set && !text.empty() && text.front() == '-') onTop = true;
    }
    Parser parser(text, percent || entry.how == How::Multiply ? Quantity::Number : quantity);
    const std::optional<Amount> amount = parser.parse();
    if (!amount) return refuse();
    entry.value = amount->value;
    if (percent) {
        if (entry.how == How::Multiply && sign < 0.0) return refuse();
        entry.value = onTop ? 1.0 + sign * entry.value / 100.0 : entry.value / 100.0;
        entry.how = How::Multiply;
        return entry;
    }
    if (entry.how == How::Multiply) {
        if (sign < 0.0) entry.value = 1.0 / entry.value;
        return std::isfinite(entry.value) ? Result<ValueEntry>(entry) : Result<ValueEntry>(refuse());
    }
    if (amount->dimension == 0) entry.value *= factorOfBareNumber(quantity);
    entry.value *= sign;
    entry.unit = parser.unit();
    return entry;
}

double changed(double before, const ValueEntry& entry) {
    switch (entry.how) {
    case ValueEntry::How::Add:
        return before + entry.value;
    case ValueEntry::How::Multiply:
        return before * entry.value;
    case ValueEntry::How::Set:
    case ValueEntry::How::Clear:
        break;
    }
    return entry.value;
}

Result<TypedIntensity> withIntensity(const LightDef& def, const ValueEntry& entry) {
    using How = ValueEntry::How;
    TypedIntensity result{def.intensity, def.unit};
    if (entry.unit && !unitApplies(def, *entry.unit)) {
        return Error{fmt::format("expected a unit that suits this light's type and size, found '{}'",
                                 unitLabel(Quantity::Intensity, *entry.unit))};
    }
    if (entry.how == How::Set) {
        result = {entry.value, entry.unit.value_or(def.unit)};
    } else if (entry.how == How::Multiply && def.unit == LightUnit::Ev100) {
        if (!(entry.value > 0.0)) return Error{"expected a factor above 0 for an intensity in EV"};
        result.value += std::log2(entry.value);
    } else if (entry.how == How::Add && entry.unit && *entry.unit != def.unit) {
        LightDef other = def;
        other.unit = *entry.unit;
        other.intensity = intensityIn(def, *entry.unit) + entry.value;
        result.value = intensityIn(other, def.unit);
    } else if (entry.how == How::Clear) {
        return Error{"expected an intensity: it cannot be left out"};
    } else {
        result.value = changed(def.intensity, entry);
    }
    if (!std::isfinite(result.value)) return Error{"expected a finite intensity"};
    return result;
}

std::string formatQuantity(double value, Quantity quantity, int digits) {
    const double shown = value / factorOfBareNumber(quantity);
    const double magnitude = std::abs(shown);
    // Whole and near numbers stay without exponents: 0.05, 120000.
    if (magnitude == 0.0) return "0";
    if (magnitude < 1e-4 || magnitude >= 1e9) return fmt::format("{:.{}g}", shown, digits);
    const int places = std::max(0, digits - 1 - int(std::floor(std::log10(magnitude))));
    std::string text = fmt::format("{:.{}f}", shown, places);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string_view unitLabel(Quantity quantity, LightUnit unit) {
    switch (quantity) {
    case Quantity::Number:
        return "";
    case Quantity::Length:
        return "m";
    case Quantity::Angle:
        return "\u00b0";
    case Quantity::Temperature:
        return "K";
    case Quantity::Exposure:
        return "EV";
    case Quantity::Intensity:
        break;
    }
    switch (unit) {
    case LightUnit::Lumen:
        return "lm";
    case LightUnit::Candela:
        return "cd";
    case LightUnit::Lux:
        return "lux";
    case LightUnit::Nit:
        return "nit";
    case LightUnit::Ev100:
        return "EV";
    }
    return "";
}

} // namespace kilolux
