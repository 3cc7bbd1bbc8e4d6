// Keys that accept a number, a number with a unit, or a formula of the position.
#include <gtest/gtest.h>

#include "lib/config/formula.h"
#include "tests/config/messages.h"

namespace orthodyn::point_quantity_test {
namespace {

PointQuantity read(const std::string& yaml) {
  return Value<PointQuantity>::read(Config::from_text("p: " + yaml, "a.yaml").at("p"), {.unit = "Pa"});
}

TEST(PointQuantity, IsANumberOrANumberWithAUnitOrAFormula) {
  EXPECT_EQ(read("12").at({1, 2, 3}), 12);
  EXPECT_EQ(read("12 kPa").at({1, 2, 3}), 12e3);
  EXPECT_EQ(read("-1e3Pa").at({1, 2, 3}), -1e3);
  EXPECT_EQ(read("12*x + y^2 - z").at({1, 2, 3}), 12 + 4 - 3);
  EXPECT_EQ(read("2*3").at({1, 2, 3}), 6);
  EXPECT_TRUE(read("12 kPa").uniform());
  EXPECT_FALSE(read("x").uniform());
}

TEST(PointQuantity, RefusesWhatIsNone) {
  const auto refused = [](const std::string& yaml) { return refusal([&] { read(yaml).at({0, 0, 0}); }); };
  EXPECT_TRUE(holds(refused("12 kg"), "a.yaml:1:4: p: expected a stress or stiffness (Pa)"));
  EXPECT_TRUE(holds(refused("12 kPaa"), "the unit 'kPaa' is not known"));
  EXPECT_TRUE(holds(refused("5*t"), "cannot read the formula '5*t'"));
  EXPECT_TRUE(holds(refused("5*t"), "Known: x, y, z"));
  EXPECT_TRUE(holds(refused("0,5*x"), "write a decimal point"));
  EXPECT_TRUE(holds(refused("x = 3"), "assign"));
  EXPECT_TRUE(holds(refused("1/x"), "'1/x' is infinite at x = 0"));
  EXPECT_TRUE(holds(refused("nan"), "finite"));
  EXPECT_TRUE(holds(refused("[1, 2]"), "a list of 2"));
}

}  // namespace
}  // namespace orthodyn::point_quantity_test
