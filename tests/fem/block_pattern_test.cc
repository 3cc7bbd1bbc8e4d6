// Assembly into the sparse pattern against assembly into a full matrix.
#include "lib/fem/block_pattern.h"

#include <gtest/gtest.h>

#include "lib/core/errors.h"
#include "lib/fem/element_assembly.h"
#include "lib/mesh/box.h"
#include "tests/material/constants.h"
#include "tests/mesh/tets.h"

namespace orthodyn::block_pattern_test {
namespace {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

std::vector<bool> random_clamps(Random& random, std::size_t nodes, double fraction) {
  std::vector<bool> clamped;
  for (std::size_t i = 0; i < 3 * nodes; ++i) clamped.push_back(random.between(0, 1) < fraction);
  return clamped;
}

Matrix12 random_element(Random& random, bool symmetric) {
  Matrix12 K = Matrix12::NullaryExpr([&] { return random.between(-1, 1); });
  if (symmetric) K = Matrix12(K + K.transpose());
  return K;
}

ElementBlocks<4> blocks_of(const Matrix12& K) {
  ElementBlocks<4> blocks;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      blocks[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = K.block<3, 3>(3 * a, 3 * b);
  return blocks;
}

void add_dense(const Matrix12& K, const Tet& tet, const DofMap& dofs, Eigen::MatrixXd& full) {
  for (int a = 0; a < 12; ++a)
    for (int b = 0; b < 12; ++b) {
      const auto dof = [&](int k) {
        return dofs.node(tet[static_cast<std::size_t>(k / 3)])[static_cast<std::size_t>(k % 3)];
      };
      if (dof(a) >= 0 && dof(b) >= 0) full(dof(a), dof(b)) += K(a, b);
    }
}

TEST(DofMap, NumbersFreeCoordinatesInTheOrderOfTheNodes) {
  const DofMap dofs(3, {false, true, false, true, true, true, false, false, false});
  EXPECT_EQ(dofs.num_dofs(), 5);
  EXPECT_EQ(dofs.node(0), (std::array{0, -1, 1}));
  EXPECT_EQ(dofs.node(1), (std::array{-1, -1, -1}));
  EXPECT_EQ(dofs.node(2), (std::array{2, 3, 4}));
}

TEST(DofMap, AddsAndRestrictsByTheSameNumbers) {
  Random random(81);
  const DofMap dofs(20, random_clamps(random, 20, 0.4));
  const Vector x = Vector::NullaryExpr(dofs.num_dofs(), [&] { return random.between(-1, 1); });
  NodalVector base = NodalVector::Constant(3, 20, 0.5);
  dofs.add_to(x, base);
  Vector back(x.size());
  dofs.restrict_to(base, back);
  EXPECT_LE((back - x - Vector::Constant(x.size(), 0.5)).cwiseAbs().maxCoeff(), 2 * kEps);
  EXPECT_NEAR(base.sum(), 30 + x.sum(), 100 * kEps);
}

class Assembly : public testing::TestWithParam<bool> {};  // symmetric
INSTANTIATE_TEST_SUITE_P(Patterns, Assembly, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "symmetric" : "general"; });

TEST_P(Assembly, OfRandomElementsEqualsTheFullMatrixForAnyClamps) {
  Random random(82);
  const Mesh mesh = make_box({.cells = {3, 2, 2}});
  for (const double fraction : {0.0, 0.3, 0.9}) {
    const DofMap dofs(static_cast<int>(mesh.nodes.size()), random_clamps(random, mesh.nodes.size(), fraction));
    const BlockPattern pattern(mesh.cells, dofs, GetParam());
    std::vector<double> values(pattern.pattern().row.size(), 0);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(dofs.num_dofs(), dofs.num_dofs());
    for (const Tet& tet : tets_of(mesh)) {
      const Matrix12 K = random_element(random, GetParam());
      add_dense(K, tet, dofs, expected);
      scatter<4>(blocks_of(K), tet, ElementOffsets<4>(tet, pattern), pattern, values.data());
    }
    Eigen::MatrixXd assembled = pattern.pattern().matrix(values.data());
    if (GetParam()) assembled = Eigen::MatrixXd(assembled.selfadjointView<Eigen::Lower>());
    EXPECT_LE((assembled - expected).cwiseAbs().maxCoeff(), 64 * kEps) << fraction;
  }
}

TEST_P(Assembly, HasAscendingRowsAndTheWholeDiagonal) {
  Random random(83);
  const Mesh mesh = make_box({.cells = {2, 2, 2}, .split = BoxMesh::Split::six});
  const DofMap dofs(static_cast<int>(mesh.nodes.size()), random_clamps(random, mesh.nodes.size(), 0.3));
  const Pattern p = BlockPattern(mesh.cells, dofs, GetParam()).pattern();
  ASSERT_EQ(p.column_start.size(), static_cast<std::size_t>(dofs.num_dofs()) + 1);
  EXPECT_EQ(p.column_start.back(), p.non_zeros());
  for (int j = 0; j < p.n; ++j) {
    const auto begin = p.row.begin() + p.column_start[static_cast<std::size_t>(j)];
    const auto end = p.row.begin() + p.column_start[static_cast<std::size_t>(j) + 1];
    EXPECT_TRUE(std::is_sorted(begin, end));
    EXPECT_EQ(std::adjacent_find(begin, end), end);
    EXPECT_TRUE(std::binary_search(begin, end, j));
    if (GetParam()) {
      EXPECT_EQ(*begin, j);
    }
  }
}

TEST(Pattern, OfASymmetricMeshIsTheLowerTriangleOfTheGeneralOne) {
  const Mesh mesh = make_box({.cells = {2, 1, 1}});
  const DofMap dofs(static_cast<int>(mesh.nodes.size()), std::vector<bool>(3 * mesh.nodes.size(), false));
  const Pattern lower = BlockPattern(mesh.cells, dofs, true).pattern(),
                all = BlockPattern(mesh.cells, dofs, false).pattern();
  EXPECT_EQ(all.non_zeros(), 2 * lower.non_zeros() - lower.n);
}

}  // namespace
}  // namespace orthodyn::block_pattern_test
