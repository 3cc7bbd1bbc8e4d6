// Tangents, strains and the smallest det F computed in batches equal those computed element by element.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "lib/fem/block_pattern.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/element_mesh.h"
#include "lib/fem/element_type.h"
#include "lib/fem/terms/elastic_term.h"
#include "lib/material/stiffness.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "tests/element/states.h"

namespace orthodyn::batched_elements_test {
namespace {

constexpr double kBeta = 0.02;

Mesh block(int order) {
  Mesh mesh = make_box({.cells = {3, 2, 1}});
  if (order == 2) make_quadratic(mesh);
  return mesh;
}

struct Sparse {
  std::vector<double> K, D;
};

class BatchedElements : public testing::TestWithParam<int> {  // order of the elements
 protected:
  BatchedElements()
      : mesh_(block(GetParam())),
        elements_(mesh_),
        dofs_(num_nodes(), clamps()),
        pattern_(elements_.cells, dofs_, true),
        rest_(3, num_nodes()) {
    for (int i = 0; i < num_nodes(); ++i) rest_.col(i) = mesh_.nodes[static_cast<std::size_t>(i)];
  }

  int num_nodes() const { return static_cast<int>(mesh_.nodes.size()); }

  // A few nodes wholly, a few in part.
  std::vector<bool> clamps() const {
    std::vector<bool> out(3 * mesh_.nodes.size(), false);
    out[0] = out[1] = out[2] = out[10] = out[15] = out[17] = true;
    return out;
  }

  std::unique_ptr<ElasticTerm> term(const std::vector<int>& cells) const {
    return elements_.type(0).elastic_term(elements_, {"body", cells, fibre(10), Random(5).rotation(), kBeta, {}},
                                          pattern_);
  }
  std::vector<int> all_cells() const {
    std::vector<int> all(elements_.cells.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  // With elements at one node inverted, if wanted.
  NodalVector displacement(Random& random, bool inverted) const {
    NodalVector u = NodalVector::NullaryExpr(3, num_nodes(), [&] { return random.between(-0.03, 0.03); });
    if (inverted) u.col(7) += Vec3(0.9, 0.7, 0.8);
    return u;
  }

  Sparse tangent(const std::vector<int>& cells, const NodalVector& u, TangentKind kind) const {
    Sparse out{std::vector<double>(pattern_.pattern().row.size(), 0), {}};
    out.D = out.K;
    const NodalVector x = rest_ + u, still = NodalVector::Zero(3, num_nodes());
    term(cells)->add_tangent({0, x, u, still}, kind, out.K.data(), out.D.data());
    return out;
  }

  Mesh mesh_;
  ElementMesh elements_;
  DofMap dofs_;
  BlockPattern pattern_;
  NodalVector rest_;
};
INSTANTIATE_TEST_SUITE_P(Orders, BatchedElements, testing::Values(1, 2));

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// A single element fills its batch with copies of itself. A batch with an inverted element is computed by the scalar
// law as a whole.
TEST_P(BatchedElements, TangentIsTheSumOfThatOfEach) {
  Random random(6);
  const std::vector<int> all = all_cells();
  for (const bool inverted : {false, true}) {
    const NodalVector u = displacement(random, inverted);
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

// The first elements, fewer each time: each element is once the last of a partly filled batch.
TEST_P(BatchedElements, StrainsAndObservationsAreThoseOfItsPoints) {
  Random random(8);
  int num_inverted = 0;
  for (const bool inverted : {false, true}) {
    const NodalVector u = displacement(random, inverted), x = rest_ + u, still = NodalVector::Zero(3, num_nodes());
    const NodalState s{0, x, u, still};
    for (std::vector<int> cells = all_cells(); !cells.empty(); cells.pop_back()) {
      const auto elastic = term(cells);
      const auto strains = elastic->strains(s);
      ASSERT_EQ(strains.cols(), elastic->size() * elastic->num_points());
      std::vector<PointObservation> seen(static_cast<std::size_t>(strains.cols()));
      std::atomic<int> visits = 0;
      elastic->observe_points(s, [&](int k, int p, const PointObservation& observation) {
        seen[static_cast<std::size_t>(k * elastic->num_points() + p)] = observation;
        ++visits;
      });
      EXPECT_EQ(visits, strains.cols());
      for (int k = 0; k < elastic->size(); ++k)
        for (int p = 0; p < elastic->num_points(); ++p) {
          const auto i = k * elastic->num_points() + p;
          const PointObservation expected = elastic->observe_point(k, p, s), &found = seen[static_cast<std::size_t>(i)];
          const Vec6 strain = voigt_strain<double>(expected.strain);
          num_inverted += elastic->det_F(k, s) <= 0;
          EXPECT_LE((strains.col(i) - strain).norm(), 1e-13 * (1 + strain.norm()))
              << "element " << k << " of " << cells.size();
          EXPECT_LE((found.strain - expected.strain).norm(), 1e-13 * (1 + strain.norm())) << k;
          EXPECT_LE((found.axes - expected.axes).norm(), 1e-12) << k;
          if (expected.cauchy.hasNaN()) EXPECT_TRUE(found.cauchy.hasNaN());
          else
            EXPECT_LE((found.cauchy - expected.cauchy).norm(),
                      1e-12 * (elastic->stiffness().norm() + expected.cauchy.norm()))
                << k;
        }
    }
  }
  EXPECT_GT(num_inverted, 0);
}

TEST_P(BatchedElements, TheSmallestDetFIsThatOfAllElements) {
  Random random(9);
  for (const bool inverted : {false, true}) {
    const NodalVector u = displacement(random, inverted), x = rest_ + u, still = NodalVector::Zero(3, num_nodes());
    const NodalState s{0, x, u, still};
    for (std::vector<int> cells = all_cells(); !cells.empty(); cells.pop_back()) {
      const auto elastic = term(cells);
      int smallest = 0;
      for (int k = 1; k < elastic->size(); ++k)
        if (elastic->det_F(k, s) < elastic->det_F(smallest, s)) smallest = k;
      const auto found = elastic->smallest_det_F(s);
      EXPECT_EQ(found.element, smallest);
      EXPECT_EQ(found.value, elastic->det_F(smallest, s));
    }
  }
}

}  // namespace
}  // namespace orthodyn::batched_elements_test
