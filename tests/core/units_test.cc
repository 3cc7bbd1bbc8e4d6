// Numbers with a unit, for keys that have a dimension.
#include "lib/core/units.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lib/config/spec.h"
#include "tests/config/messages.h"

namespace orthodyn::units_test {
namespace {

double read(const std::string& yaml, const Rule& rule) {
  return Value<double>::read(Config::from_text(yaml, "a.yaml"), rule);
}

std::string refusal_of(const std::string& yaml, const Rule& rule) {
  return refusal([&] { read(yaml, rule); });
}

TEST(Units, AreConvertedToSi) {
  EXPECT_DOUBLE_EQ(read("11.9 GPa", {.unit = "Pa"}), 11.9e9);
  EXPECT_DOUBLE_EQ(read("25mm", {.unit = "m"}), 0.025);
  EXPECT_DOUBLE_EQ(read("0.45 g/cm^3", {.unit = "kg/m^3"}), 450);
  EXPECT_DOUBLE_EQ(read("1 inch", {.unit = "m"}), 0.0254);
  EXPECT_DOUBLE_EQ(read("2 kN", {.unit = "N"}), 2000);
  EXPECT_DOUBLE_EQ(read("3 N/mm^2", {.unit = "Pa"}), 3e6);
  EXPECT_DOUBLE_EQ(read("-5e-1 ms", {.unit = "s"}), -5e-4);
  EXPECT_DOUBLE_EQ(read("+5 ms", {.unit = "s"}), 5e-3);
  EXPECT_DOUBLE_EQ(read("3 1/s", {.unit = "1/s"}), 3);
  for (const char* text : {"'+ 5 ms'", "+-5 ms", "++5 ms"})
    EXPECT_TRUE(holds(refusal_of(text, {.unit = "s"}), "expected a time (s)")) << text;
}

TEST(Units, ANumberWithoutOneIsInSi) { EXPECT_EQ(read("11.9e9", {.unit = "Pa"}), 11.9e9); }

TEST(Units, AnglesTurnDegreesIntoRadians) {
  EXPECT_DOUBLE_EQ(read("30 deg", {.unit = "rad"}), std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(read("30 degrees", {.unit = "rad"}), std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(read("0.5 rad", {.unit = "rad"}), 0.5);
  EXPECT_DOUBLE_EQ(read("180 deg/s", {.unit = "rad/s"}), std::numbers::pi);
}

TEST(Units, AnAngleWithoutOneIsRefusedWithBothReadings) {
  EXPECT_EQ(refusal_of("30", {.unit = "rad"}), "a.yaml:1:1: an angle needs a unit: give '30 deg' or '30 rad'");
  EXPECT_EQ(refusal_of("-1e-3", {.unit = "rad"}), "a.yaml:1:1: an angle needs a unit: give '-1e-3 deg' or '-1e-3 rad'");
  EXPECT_EQ(read("0", {.unit = "rad"}), 0);
  EXPECT_EQ(read("-0.0", {.unit = "rad"}), 0);
  EXPECT_EQ(read("30", {.unit = "rad/s"}), 30);
}

TEST(Units, AFrequencyIsNoAngularVelocity) {
  EXPECT_EQ(refusal_of("5 Hz", {.unit = "rad/s"}),
            "a.yaml:1:1: expected an angular velocity (rad/s), found '5 Hz', a rate (1/s)");
  EXPECT_TRUE(holds(refusal_of("5 rad/s", {.unit = "Hz"}), "an angular velocity (rad/s)"));
  EXPECT_EQ(read("5 kHz", {.unit = "Hz"}), 5000);
}

TEST(Units, TheWrongDimensionIsRefusedWithBothNames) {
  EXPECT_EQ(refusal_of("25 mm", {.unit = "Pa"}),
            "a.yaml:1:1: expected a stress or stiffness (Pa), found '25 mm', a length (m)");
  EXPECT_EQ(refusal_of("3 kg", {.unit = "kg/m^3"}),
            "a.yaml:1:1: expected a density (kg/m^3), found '3 kg', a mass (kg)");
}

TEST(Units, AnUnknownUnitIsNamed) {
  EXPECT_EQ(refusal_of("3 gpa", {.unit = "Pa"}),
            "a.yaml:1:1: expected a stress or stiffness (Pa), found '3 gpa': the unit 'gpa' is not known; did you mean "
            "'GPa'?");
  EXPECT_TRUE(holds(refusal_of("3 KN", {.unit = "N"}), "did you mean 'kN'?"));
  EXPECT_FALSE(holds(refusal_of("3 gpx", {.unit = "Pa"}), "did you mean"));
}

TEST(Units, ADecimalCommaIsNamed) {
  EXPECT_EQ(
      refusal_of("'10,8 GPa'", {.unit = "Pa"}),
      "a.yaml:1:1: expected a stress or stiffness (Pa), found '10,8 GPa', with a decimal comma; write '10.8 GPa'");
  EXPECT_TRUE(
      holds(refusal_of("0,44", {}), "expected a plain number, found '0,44', with a decimal comma; write '0.44'"));
}

TEST(Units, AKeyWithoutDimensionTakesPlainNumbersOnly) {
  EXPECT_EQ(refusal_of("0.3 m", {}), "a.yaml:1:1: expected a plain number, found '0.3 m', a length (m)");
}

TEST(Units, APercentageIsNamedAsNoUnit) {
  EXPECT_TRUE(holds(refusal_of("30 %", {}),
                    "expected a plain number, found '30 %': the unit % is not allowed here; write 0.3, or 30 if the "
                    "quantity is in per cent"));
  EXPECT_TRUE(holds(refusal_of("5 %", {.unit = "Pa"}), "found '5 %': the unit % is not allowed here"));
}

TEST(Units, WordsAreNoQuantities) {
  EXPECT_EQ(refusal_of("soft", {.unit = "Pa"}), "a.yaml:1:1: expected a number, found 'soft'");
  EXPECT_TRUE(
      holds(refusal_of("steel 2 GPa", {.unit = "Pa"}), "expected a stress or stiffness (Pa), found 'steel 2 GPa'"));
  EXPECT_TRUE(holds(refusal_of("2 GPa 3", {.unit = "Pa"}), "found '2 GPa 3'"));
}

TEST(Units, RangesHoldForTheConvertedNumber) {
  EXPECT_EQ(refusal_of("-2 GPa", {.unit = "Pa", .range = kPositive}), "a.yaml:1:1: must be > 0 Pa, found -2000000000");
}

TEST(Units, EachNumberOfAListMayHaveItsOwn) {
  const auto x = Value<Vec3>::read(Config::from_text("[1 m, 2 cm, 3]"), {.unit = "m"});
  EXPECT_EQ(x, Vec3(1, 0.02, 3));
}

TEST(Units, ARateOfChangeIsToldApartFromItsInverse) {
  EXPECT_TRUE(holds(refusal_of("2 s", {.unit = "1/s"}), "found '2 s', a time (s)"));
  EXPECT_EQ(read("2 s^-1", {.unit = "1/s"}), 2);
  EXPECT_EQ(read("2 1/s", {.unit = "1/s"}), 2);
}

}  // namespace
}  // namespace orthodyn::units_test
