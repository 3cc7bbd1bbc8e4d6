// The linear hexahedron and wedge.
#include <gtest/gtest.h>

#include "lib/element/hex8.h"
#include "lib/element/wedge6.h"
#include "tests/element/isoparametric_tests.h"

namespace orthodyn::linear_cells_test {
namespace {

using namespace isoparametric_tests;

struct Hex8Case {
  using Element = Hex8;
  static constexpr int kZeroModes = 6;
  static constexpr bool kQuadraticIfBilinear = false;
  static bool interpolates(int i, int j, int k) { return std::max({i, j, k}) <= 1; }
};

struct Wedge6Case {
  using Element = Wedge6;
  static constexpr int kZeroModes = 6;
  static constexpr bool kQuadraticIfBilinear = false;
  static bool interpolates(int i, int j, int k) { return i + j <= 1 && k <= 1; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Hex8, IsoparametricElement, Hex8Case);
INSTANTIATE_TYPED_TEST_SUITE_P(Wedge6, IsoparametricElement, Wedge6Case);

}  // namespace
}  // namespace orthodyn::linear_cells_test
