// How each type of value is read, checked and written.
#include "lib/config/values.h"

#include <gtest/gtest.h>

#include "lib/config/spec.h"
#include "tests/config/messages.h"

namespace orthodyn {

namespace values_test {
enum class Split { five, six };
}

template <>
struct EnumNames<values_test::Split> {
  using Split = values_test::Split;
  static constexpr std::array<std::pair<Split, const char*>, 2> list{{{Split::five, "five"}, {Split::six, "six"}}};
};

namespace values_test {
namespace {

template <class V>
V read(const std::string& text, const Rule& rule = {}) {
  return Value<V>::read(Config::from_text(text, "a.yaml"), rule);
}

template <class V>
std::string refusal_of(const std::string& text, const Rule& rule = {}) {
  return refusal([&] { read<V>(text, rule); });
}

TEST(Range, OpenEndsExcludeTheirNumber) {
  const Range range{-1, 0.5, true, true};
  EXPECT_FALSE(range.contains(-1));
  EXPECT_FALSE(range.contains(0.5));
  EXPECT_TRUE(range.contains(0.5 - 1e-16));
}

TEST(Range, ClosedEndsIncludeTheirNumber) {
  const Range range{-1, 0.5};
  EXPECT_TRUE(range.contains(-1));
  EXPECT_TRUE(range.contains(0.5));
  EXPECT_FALSE(range.contains(0.5 + 1e-15));
}

TEST(Range, IsSaidInWords) {
  EXPECT_EQ(range_text({}), "");
  EXPECT_EQ(range_text(kPositive), "> 0");
  EXPECT_EQ(range_text(kNonNegative), ">= 0");
  EXPECT_EQ(range_text({-1, 0.5, true, false}), "in (-1, 0.5]");
  EXPECT_EQ(range_text({.high = 2}), "<= 2");
}

TEST(ReadNumber, OutsideTheRangeIsRefusedWithRangeUnitAndValue) {
  EXPECT_EQ(refusal_of<double>("-3", {.unit = "Pa", .range = kPositive}), "a.yaml:1:1: must be > 0 Pa, found -3");
}

TEST(ReadInteger, OutsideItsTypeIsRefused) {
  EXPECT_EQ(read<int>("2147483647"), 2147483647);
  EXPECT_TRUE(holds(refusal_of<int>("2147483648"), "must be in [-2147483648, 2147483647]"));
  EXPECT_TRUE(holds(refusal_of<unsigned>("-1"), "must be in [0, 4294967295]"));
}

TEST(ReadEnum, TakesItsWords) {
  EXPECT_EQ(read<Split>("six"), Split::six);
  EXPECT_EQ(type_text(Value<Split>::schema()), "five|six");
}

TEST(ReadEnum, RefusesOtherWordsWithTheNearestOne) {
  EXPECT_TRUE(holds(refusal_of<Split>("fiv"), "expected one of five, six, found 'fiv'; did you mean 'five'?"));
}

// Nonzero quantities of any unit must have magnitudes from 1e-100 to 1e100, so that their squares and products neither
// overflow nor underflow.
TEST(ReadNumber, OfAQuantityIsOneThatCanBeComputedWith) {
  for (const char* unit : {"m", "Pa", "kg/m^3", "m/s^2", "N", "s"}) {
    for (const char* text : {"0", "1e-100", "-1e-100", "1e100", "-1e100", "1e-9", "-0.0"})
      EXPECT_NO_THROW(read<double>(text, {.unit = unit})) << text;
    for (const char* text : {"1e-101", "-1e-101", "1e101", "1e308", "-1e308", "1e-308", "5e-324"}) {
      EXPECT_TRUE(starts(refusal_of<double>(text, {.unit = unit}), "a.yaml:1:")) << text;
      EXPECT_TRUE(holds(refusal_of<double>(text, {.unit = unit}), "out of range")) << text;
    }
  }
  EXPECT_TRUE(holds(refusal_of<double>("1e99 Gm", {.unit = "m"}), "out of range"));
  EXPECT_EQ(read<double>("1e300"), 1e300);  // without a unit there is no limit
}

TEST(ReadVec3, AsksForAUnitThatItsNeighbourHas) {
  const Rule stiffness{.unit = "Pa"}, length{.unit = "m"};
  EXPECT_EQ(
      refusal_of<Vec3>("[10.8 GPa, 0.84, 0.46]", stiffness),
      "a.yaml:1:12: 1: unit missing: '0.84' is next to '10.8 GPa'; write '0.84 GPa', or '0.84 Pa' if you mean that");
  EXPECT_TRUE(holds(refusal_of<Vec3>("[2, 2, 1 um]", length), "a.yaml:1:2: 0: unit missing: '2' is next to '1 um'"));
  EXPECT_TRUE(holds(refusal_of<Vec3>("[2, 2, 3 km]", length), "write '2 km'"));
  EXPECT_TRUE(holds(refusal_of<Vec3>("[400 mm, 40, 12]", length), "write '40 mm'"));
  EXPECT_TRUE(holds(refusal_of<Vec3>("[400 mm, 2 cm, 40]", length), "'40' is next to '400 mm'"));
  EXPECT_TRUE(holds(refusal_of<Vec3>("[10800, 0.84 GPa, 0.46 GPa]", stiffness),
                    "'10800' is next to '0.84 GPa'; write '10800 MPa', or '10800 Pa' if you mean that"));
  EXPECT_EQ(read<Vec3>("[1 m, 2 cm, 3]", length), Vec3(1, 0.02, 3));  // 3 is close to 1 m
  // As made by --set young.0=12e9.
  EXPECT_EQ(read<Vec3>("[12e9, 0.84 GPa, 0.46 GPa]", stiffness), Vec3(12e9, 0.84e9, 0.46e9));
  EXPECT_EQ(read<Vec3>("[0, 0, -9.81 m/s^2]", {.unit = "m/s^2"}), Vec3(0, 0, -9.81));
  EXPECT_EQ(read<Vec3>("[0.02, 2 cm, 1]", length), Vec3(0.02, 0.02, 1));
  EXPECT_EQ(read<Vec3>("[1 m, 100, 0.01]", length), Vec3(1, 100, 0.01));
}

TEST(ReadVec3, NeedsThreeNumbers) {
  EXPECT_EQ(read<Vec3>("[1, 2, 3]"), Vec3(1, 2, 3));
  EXPECT_TRUE(holds(refusal_of<Vec3>("[1, 2]"), "expected a list of 3 numbers, found a list of 2"));
  EXPECT_TRUE(holds(refusal_of<Vec3>("5"), "expected a list of 3 numbers, found '5'"));
}

TEST(ReadVec3, ChecksTheRangeOfEachNumber) {
  EXPECT_TRUE(starts(refusal_of<Vec3>("[1, -2, 3]", {.range = kPositive}), "a.yaml:1:5: 1: must be > 0"));
}

TEST(ReadMat3, TakesRows) {
  const Mat3 m = read<Mat3>("[[1, 2, 3], [4, 5, 6], [7, 8, 9]]");
  EXPECT_EQ(m(0, 2), 3);
  EXPECT_EQ(m(2, 0), 7);
  EXPECT_TRUE(holds(refusal_of<Mat3>("[[1, 2, 3]]"), "expected three rows"));
}

TEST(ReadOptional, HasAValueIfThereIsOne) {
  EXPECT_EQ(read<std::optional<double>>("3"), 3.0);
  EXPECT_EQ(Value<std::optional<double>>::yaml(std::nullopt), "");
}

TEST(ReadVector, TakesAnyNumberOfEntries) {
  EXPECT_EQ(read<std::vector<int>>("[]").size(), 0u);
  EXPECT_EQ(read<std::vector<int>>("[3, 1, 2]"), (std::vector<int>{3, 1, 2}));
  EXPECT_TRUE(holds(refusal_of<std::vector<int>>("3"), "expected a list"));
}

TEST(ReadArray, NeedsItsNumberOfEntries) {
  using Pair = std::array<int, 2>;
  EXPECT_EQ(read<Pair>("[3, 1]"), (Pair{3, 1}));
  EXPECT_TRUE(holds(refusal_of<Pair>("[3]"), "expected a list of 2, found a list of 1"));
}

TEST(ReadNamed, KeepsTheOrderOfTheFile) {
  const auto named = read<Named<int>>("{z: 1, a: 2, m: 3}");
  ASSERT_EQ(named.size(), 3u);
  EXPECT_EQ(named[0].first, "z");
  EXPECT_EQ(named[1].second, 2);
  EXPECT_EQ(named[2].first, "m");
}

TEST(ReadNamed, RefusesAList) {
  EXPECT_TRUE(holds(refusal_of<Named<int>>("[1]"), "expected named sections, found a list of 1"));
}

TEST(WriteValue, IsReadBackToTheSameValue) {
  const Vec3 v(1.0 / 3, -1e-300, 6.02214076e23);
  EXPECT_EQ(read<Vec3>(Value<Vec3>::yaml(v)), v);
  const Mat3 m = v * v.transpose();
  EXPECT_EQ(read<Mat3>(Value<Mat3>::yaml(m)), m);
  EXPECT_EQ(read<bool>(Value<bool>::yaml(true)), true);
  EXPECT_EQ(read<Split>(Value<Split>::yaml(Split::six)), Split::six);
  EXPECT_EQ(read<std::vector<double>>(Value<std::vector<double>>::yaml({0.1, 2})), (std::vector<double>{0.1, 2}));
}

}  // namespace
}  // namespace values_test
}  // namespace orthodyn
