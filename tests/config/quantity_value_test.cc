// Values whose unit is determined by a quantity named at another key.
#include "lib/config/quantity_value.h"

#include <gtest/gtest.h>

#include "tests/config/messages.h"

namespace orthodyn::quantity_value_test {
namespace {

QuantityValue read(const std::string& text, const Rule& rule = {}) {
  return Value<QuantityValue>::read(Config::from_text(text, "a.yaml"), rule);
}

TEST(QuantityValue, IsANumberInSiUnitsOrHasAUnit) {
  EXPECT_EQ(read("3").si(), 3);
  EXPECT_DOUBLE_EQ(read("1 mJ").si(), 1e-3);
  EXPECT_DOUBLE_EQ(read("-2 mm").si(), -2e-3);
  EXPECT_DOUBLE_EQ(read("3 1/s").si(), 3);
}

TEST(QuantityValue, TakesTheUnitsOfItsQuantityOnly) {
  const SourceLocation here{"a.yaml:1:1"};
  EXPECT_NO_THROW(read("1 mJ").require("J", here));
  EXPECT_NO_THROW(read("1").require("J", here));
  EXPECT_NO_THROW(read("1").require("", here));
  EXPECT_EQ(refusal([&] { read("1 mm").require("J", here); }),
            "a.yaml:1:1: expected an energy (J), found the unit 'mm', a length (m)");
  EXPECT_TRUE(holds(refusal([&] { read("1 mm").require("", here); }), "expected a plain number"));
  EXPECT_TRUE(holds(refusal([&] { read("1 mm").require("1", here); }), "expected a plain number"));
}

TEST(QuantityValue, RefusesWhatIsNoQuantityOrOutOfRange) {
  EXPECT_TRUE(holds(refusal([] { read("3 furlongz"); }), "the unit 'furlongz' is not known"));
  EXPECT_TRUE(holds(refusal([] { read("much"); }), "expected a number, found 'much'"));
  EXPECT_TRUE(holds(refusal([] { read("[1]"); }), "expected a number"));
  EXPECT_TRUE(holds(refusal([] { read("-1 mJ", {.range = kPositive}); }), "must be > 0, found '-1 mJ'"));
}

}  // namespace
}  // namespace orthodyn::quantity_value_test
