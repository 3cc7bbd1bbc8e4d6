// Tangents that are computed for a batch of elements at a time are those of the elements one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "lib/fem/element_mesh.h"
#include "lib/fem/element_type.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "tests/element/states.h"

namespace orthodyn::batch_tangent_test {
namespace {

constexpr double kBeta = 0.02;

TetMesh block(int order) {
  TetMesh mesh = make_box({.cells = {3, 2, 1}});
  if (order == 2) make_quadratic(mesh);
  return mesh;
}

struct Sparse {
  std::vector<double> K, D;
};

class BatchTangent : public testing::TestWithParam<int> {  // order of the elements
 protected:
  BatchTangent()
      : mesh_(block(GetParam())), elements_(mesh_), dofs_(num_nodes(), clamps()),
        pattern_(elements_.cells, dofs_, true), rest_(3, num_nodes()) {
    for (int i = 0; i < num_nodes(); ++i) rest_.col(i) = mesh_.nodes[static_cast<std::size_t>(i)];
  }

  int num_nodes() const { return static_cast<int>(mesh_.nodes.size()); }

  // A few nodes wholly, a few in part.
  std::vector<bool> clamps() const {
    std::vector<bool> out(3 * mesh_.nodes.size(), false);
    out[0] = out[1] = out[2] = out[10] = out[15] = out[17] = true;
    return out;
  }

  Sparse tangent(const std::vector<int>& cells, const NodalVector& u, TangentKind kind) const {
    const auto term = elements_.type.elastic_term(
        elements_, {"body", cells, fibre(10), Random(5).rotation(), kBeta, {}}, pattern_);
    Sparse out{std::vector<double>(pattern_.pattern().row.size(), 0), {}};
    out.D = out.K;
    const NodalVector x = rest_ + u, still = NodalVector::Zero(3, num_nodes());
    term->add_tangent({0, x, u, still}, kind, out.K.data(), out.D.data());
    return out;
  }

  TetMesh mesh_;
  ElementMesh elements_;
  DofMap dofs_;
  BlockPattern pattern_;
  NodalVector rest_;
};
INSTANTIATE_TEST_SUITE_P(Orders, BatchTangent, testing::Values(1, 2));

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// Alone an element fills its batch with copies of itself: inverted, the batch goes to the scalar law; together with
// others it takes them along.
TEST_P(BatchTangent, IsTheSumOfThatOfItsElements) {
  Random random(6);
  std::vector<int> all(elements_.cells.size());
  std::iota(all.begin(), all.end(), 0);
  for (const bool inverted : {false, true}) {
    NodalVector u = NodalVector::NullaryExpr(3, num_nodes(), [&] { return random.between(-0.03, 0.03); });
    if (inverted) u.col(7) += Vec3(0.9, 0.7, 0.8);
    for (const auto kind : {TangentKind::exact, TangentKind::gauss_newton}) {
      const Sparse together = tangent(all, u, kind);
      Sparse sum{std::vector<double>(together.K.size(), 0), std::vector<double>(together.K.size(), 0)};
      double size = 0;
      for (const int cell : all) {
        const Sparse one = tangent({cell}, u, kind);
        for (std::size_t i = 0; i < sum.K.size(); ++i) {
          sum.K[i] += one.K[i], sum.D[i] += one.D[i];
          size = std::max({size, std::abs(one.K[i]), std::abs(one.D[i])});
        }
      }
      EXPECT_LE(largest_difference(together.K, sum.K), 1e-12 * size) << inverted;
      EXPECT_LE(largest_difference(together.D, sum.D), 1e-12 * size) << inverted;
    }
  }
}

}  // namespace
}  // namespace orthodyn::batch_tangent_test
