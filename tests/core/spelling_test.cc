// Unknown names: the suggested name, and the sentence that suggests it.
#include "lib/core/spelling.h"

#include <gtest/gtest.h>

namespace orthodyn::words_test {
namespace {

TEST(Join, SeparatesNames) {
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(join({"a", "b"}, "|"), "a|b");
  EXPECT_EQ(join({}), "");
}

TEST(DidYouMean, NamesTheNearest) {
  const std::vector<std::string> names{"density", "young", "shear_factor", "shear"};
  EXPECT_EQ(did_you_mean("densty", names), "; did you mean 'density'?");
  EXPECT_EQ(did_you_mean("yuong", names), "; did you mean 'young'?");
  EXPECT_EQ(did_you_mean("shearfactor", names), "; did you mean 'shear_factor'?");
}

TEST(DidYouMean, TakesASwapOfNeighboursForOneChange) {
  EXPECT_EQ(did_you_mean("g31", {"nu31", "g12", "g23", "g13"}), "; did you mean 'g13'?");
}

TEST(DidYouMean, NamesNothingThatIsFar) {
  EXPECT_EQ(did_you_mean("gravity", {"density", "young"}), "");
  EXPECT_EQ(did_you_mean("hex", {"tetrahedra", "hexahedra", "wedges"}), "; did you mean 'hexahedra'?");
  EXPECT_EQ(did_you_mean("gravity", {"density", "young"}, "."), ".");
  EXPECT_EQ(did_you_mean("x", {}), "");
}

TEST(DidYouMean, PrefersTheExactEntryAndOfEqualOnesTheFirst) {
  EXPECT_EQ(did_you_mean("nu12", {"nu21", "nu13", "nu12"}), "; did you mean 'nu12'?");
  EXPECT_EQ(did_you_mean("nu1", {"nu12", "nu13"}), "; did you mean 'nu12'?");
}

// A third of the letters may differ, or two letters if that is more.
TEST(DidYouMean, AllowsMoreSlipsInALongerName) {
  EXPECT_EQ(did_you_mean("ab", {"cd"}), "; did you mean 'cd'?");
  EXPECT_EQ(did_you_mean("abc", {"xyz"}), "");
  EXPECT_EQ(did_you_mean("abcdefghi", {"xyzdefghi"}), "; did you mean 'xyzdefghi'?");
  EXPECT_EQ(did_you_mean("abcdefghi", {"xyzwefghi"}), "");
}

TEST(NearestNames, AreSoManyInTheOrderOfTheirDistance) {
  const std::vector<std::string> known{"abcd", "abxx", "xyzw", "abcx"};
  EXPECT_EQ(nearest_names("abcd", known, 3), (std::vector<std::string>{"abcd", "abcx", "abxx"}));
  EXPECT_EQ(nearest_names("abcd", {"b"}, 3), std::vector<std::string>{"b"});
}

TEST(ExpectedOneOf, ListsWhatIsKnown) {
  EXPECT_EQ(expected_one_of({"klu", "cholmod"}, "klo"),
            "expected one of klu, cholmod, found 'klo'; did you mean 'klu'?");
  EXPECT_EQ(expected_one_of({"klu", "cholmod"}, "superlu_mt"), "expected one of klu, cholmod, found 'superlu_mt'");
}

}  // namespace
}  // namespace orthodyn::words_test
