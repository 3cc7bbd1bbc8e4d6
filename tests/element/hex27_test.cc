#include "lib/element/hex27.h"

#include <gtest/gtest.h>

#include "tests/element/isoparametric_tests.h"

namespace orthodyn::hex27_test {
namespace {

using namespace isoparametric_tests;

struct Hex27Case {
  using Element = Hex27;
  static constexpr int kZeroModes = 6;
  static constexpr bool kQuadraticIfBilinear = true;
  static bool interpolates(int, int, int) { return true; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Hex27, IsoparametricElement, Hex27Case);

TEST(Hex27, LumpedSharesAreAlsoTheRowSumsOfTheConsistentMass) {
  const Vector sums = Hex27::consistent_mass(Hex27::nodes(), 1).rowwise().sum() / 8;
  for (int a = 0; a < 27; ++a) EXPECT_NEAR(sums[a], Hex27::kLumpedShares[static_cast<std::size_t>(a)], 1e-14) << a;
}

}  // namespace
}  // namespace orthodyn::hex27_test
