// Typed values: what they mean, that garbage is refused with one message, and that shown numbers read back.
#include "ui/value_entry.h"

#include "renderer/document/light_units.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace kilolux {
namespace {

using How = ValueEntry::How;

struct Case {
    const char* text;
    Quantity quantity;
    How how;
    double value;
    std::optional<LightUnit> unit = std::nullopt;
};

TEST(ValueEntry, NumbersWithUnitsAndArithmetic) {
    const double degree = glm::pi<double>() / 180.0;
    const Case cases[] = {
        {"800 lm", Quantity::Intensity, How::Set, 800.0, LightUnit::Lumen},
        {"2.5k cd", Quantity::Intensity, How::Set, 2500.0, LightUnit::Candela},
        {"2.5 klm", Quantity::Intensity, How::Set, 2500.0, LightUnit::Lumen},
        {"1M nits", Quantity::Intensity, How::Set, 1e6, LightUnit::Nit},
        {"3 cd/m2", Quantity::Intensity, How::Set, 3.0, LightUnit::Nit},
        {"9 EV100", Quantity::Intensity, How::Set, 9.0, LightUnit::Ev100},
        {"  1200  ", Quantity::Intensity, How::Set, 1200.0},
        {"50 cm", Quantity::Length, How::Set, 0.5},
        {"50CM", Quantity::Length, How::Set, 0.5},
        {"1.2", Quantity::Length, How::Set, 1.2},
        {"2 km", Quantity::Length, How::Set, 2000.0},
        {"1 m + 20 cm", Quantity::Length, How::Set, 1.2},
        {"1/2 m", Quantity::Length, How::Set, 0.5},
        {"150 cm + 1/2 m", Quantity::Length, How::Set, 2.0},
        {"1/4 cm", Quantity::Length, How::Set, 0.0025},
        {"2 * 50 cm", Quantity::Length, How::Set, 1.0},
        {"6 ft", Quantity::Length, How::Set, 1.8288},
        {"30 deg", Quantity::Angle, How::Set, 30.0 * degree},
        {"30", Quantity::Angle, How::Set, 30.0 * degree},
        {"30\u00b0", Quantity::Angle, How::Set, 30.0 * degree},
        {"0.5 rad", Quantity::Angle, How::Set, 0.5},
        {"1/2", Quantity::Number, How::Set, 0.5},
        {"(1 + 2) * -3", Quantity::Number, How::Set, -9.0},
        {"-4.5", Quantity::Number, How::Set, -4.5},
        {"2700 K", Quantity::Temperature, How::Set, 2700.0},
        {"6.5k", Quantity::Temperature, How::Set, 6500.0},
        {"-2 stops", Quantity::Exposure, How::Set, -2.0},
        {"*2", Quantity::Length, How::Multiply, 2.0},
        {"/4", Quantity::Intensity, How::Multiply, 0.25},
        {"+10 %", Quantity::Intensity, How::Multiply, 1.1},
        {"-10%", Quantity::Intensity, How::Multiply, 0.9},
        {"-=10%", Quantity::Length, How::Multiply, 0.9},
        {"50 %", Quantity::Length, How::Multiply, 0.5},
        {"+20 cm", Quantity::Length, How::Add, 0.2},
        {"-= 20 cm", Quantity::Length, How::Add, -0.2},
        {"+=1", Quantity::Exposure, How::Add, 1.0},
        {"+100 lm", Quantity::Intensity, How::Add, 100.0, LightUnit::Lumen},
        {"none", Quantity::Temperature, How::Clear, 0.0},
    };
    for (const Case& each : cases) {
        const Result<ValueEntry> entry = parseEntry(each.text, each.quantity);
        ASSERT_TRUE(entry) << each.text << ": " << entry.error();
        EXPECT_EQ(entry.value().how, each.how) << each.text;
        EXPECT_NEAR(entry.value().value, each.value, 1e-12 * std::max(1.0, std::abs(each.value)))
            << each.text;
        EXPECT_EQ(entry.value().unit, each.unit) << each.text;
    }
}

TEST(ValueEntry, GarbageIsRefusedWithWhatWasExpected) {
    const char* const cases[] = {"",         " ",         "abc",   "1 2",  "1,5",   "--",   "1..2", "nan",
                                 "inf",      "1e999",     "12 kg", "*",    "+",     "5 +",  "(1",   "1)",
                                 "1 / 0",    "1 m * 2 m", "*/2",   "%",    "/50 %", "5 lm", "0x10", "1 m + 2",
                                 "\xff\xfe", "50 cmm",    "/0",    "1;rm", "\u00b0"};
    for (const char* text : cases) {
        const Result<ValueEntry> entry = parseEntry(text, Quantity::Length);
        ASSERT_FALSE(entry) << "'" << text << "' gave " << entry.value().value;
        EXPECT_NE(entry.error().find("expected a length such as '50 cm'"), std::string::npos)
            << entry.error();
        EXPECT_NE(entry.error().find(text), std::string::npos) << entry.error();
    }
    EXPECT_FALSE(parseEntry("1 lm + 1 cd", Quantity::Intensity));
    EXPECT_FALSE(parseEntry("+1 lm %", Quantity::Intensity));
    EXPECT_FALSE(parseEntry(std::string(100'000, '('), Quantity::Number));
    EXPECT_FALSE(parseEntry(std::string(100'000, '-'), Quantity::Number));
    EXPECT_LT(parseEntry(std::string(100'000, 'x'), Quantity::Number).error().size(), 200u);
}

TEST(ValueEntry, ShownNumbersReadBack) {
    for (const Quantity quantity :
         {Quantity::Number, Quantity::Length, Quantity::Angle, Quantity::Temperature}) {
        for (const double value :
             {0.0, 0.05, 0.1, 1.0, 0.3333333333333333, 120000.0, 12.5, 1e-7, 3e12, -2.25}) {
            const double inside = quantity == Quantity::Angle ? value * glm::pi<double>() / 180.0 : value;
            const Result<ValueEntry> entry = parseEntry(formatQuantity(inside, quantity, 17), quantity);
            ASSERT_TRUE(entry) << value;
            EXPECT_NEAR(entry.value().value, inside, 1e-15 * std::abs(inside)) << value;
        }
    }
    EXPECT_EQ(formatQuantity(0.5, Quantity::Length), "0.5");
    EXPECT_EQ(formatQuantity(1.0 / 3.0, Quantity::Number, 4), "0.3333");
    EXPECT_EQ(formatQuantity(glm::pi<double>() / 6.0, Quantity::Angle), "30");
    EXPECT_EQ(formatQuantity(120000.0, Quantity::Number), "120000");
    EXPECT_EQ(formatQuantity(0.99999999, Quantity::Number), "1");
}

TEST(ValueEntry, IntensitiesKeepTheirUnit) {
    LightDef def;
    def.unit = LightUnit::Candela;
    def.intensity = 10.0;
    const auto after = [&](const char* text) {
        const Result<TypedIntensity> typed =
            withIntensity(def, parseEntry(text, Quantity::Intensity).value());
        EXPECT_TRUE(typed) << text;
        return typed ? typed.value() : TypedIntensity{};
    };
    EXPECT_EQ(after("800 lm").unit, LightUnit::Lumen);
    EXPECT_EQ(after("800 lm").value, 800.0);
    EXPECT_EQ(after("20").unit, LightUnit::Candela);
    EXPECT_EQ(after("*2").value, 20.0);
    // 4 pi lumens are one candela of a sphere.
    EXPECT_NEAR(after("+12.566370614359172 lm").value, 11.0, 1e-12);
    EXPECT_EQ(after("+12 lm").unit, LightUnit::Candela);
    // Twice the light is one stop.
    def.radiusM = 0.1;
    def.unit = LightUnit::Ev100;
    EXPECT_NEAR(after("*2").value, 11.0, 1e-12);
    EXPECT_EQ(after("+1").value, 11.0);
    // No lumens of a sun, no luminance of a point.
    def.type = LightType::Directional;
    EXPECT_FALSE(withIntensity(def, parseEntry("5 lm", Quantity::Intensity).value()));
    def.type = LightType::Sphere;
    def.radiusM = 0.0;
    EXPECT_FALSE(withIntensity(def, parseEntry("5 nit", Quantity::Intensity).value()));
}

} // namespace
} // namespace kilolux
