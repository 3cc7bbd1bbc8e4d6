// Input of all 21 constants: order of the entries, and refused sets.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/anisotropy.h"
#include "lib/material/material.h"
#include "tests/config/messages.h"
#include "tests/material/constants.h"

namespace orthodyn::anisotropic_test {
namespace {

constexpr const char* kUsual = "11-22-33-23-13-12";
constexpr const char* kOurs = "11-22-33-12-23-31";

// The YAML of a matrix, with the entries of `table` in the given Voigt order.
std::string input(const Mat6& table, const std::string& order, const std::string& more = "") {
  std::string yaml = "{type: anisotropic, density: 1, voigt_order: " + order + more;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) yaml += fmt::format(", c{}{}: {}", i + 1, j + 1, table(i, j));
  return yaml + "}";
}

std::shared_ptr<const Material> read(const std::string& yaml) {
  return Registry<Material>::read(Config::from_text(yaml, "a.yaml"));
}
Mat6 stiffness_of(const std::string& yaml) { return voigt(read(yaml)->stiffness()); }
std::string refusal_of(const std::string& yaml) {
  return refusal([&] { read(yaml); });
}

Mat6 random_positive(Random& random) {
  const Mat6 A = Mat6::NullaryExpr([&] { return random.between(-1, 1); });
  return A * A.transpose() + 0.1 * Mat6::Identity();
}

TEST(Anisotropic, InTheOrderOfThisProjectIsTheMatrixGiven) {
  Random random(70);
  const Mat6 C = random_positive(random);
  EXPECT_EQ(stiffness_of(input(C, kOurs)), C);
}

// Compares tensor components. pair[i] is the pair of tensor indices that index i of the table stands for.
void expect_components(const std::string& order, const std::array<std::array<int, 2>, 6>& pair) {
  Random random(71);
  const Mat6 table = random_positive(random);
  const Mat6 C = stiffness_of(input(table, order));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_EQ(component(C, pair[i][0], pair[i][1], pair[j][0], pair[j][1]),
                table(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)))
          << order << i << j;
}

TEST(Anisotropic, InTheUsualOrderHasItsComponentsWhereTheTableSays) {
  expect_components(kUsual, {{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}});
}

TEST(Anisotropic, InTheOrderOfAbaqusHasItsComponentsWhereTheTableSays) {
  expect_components("abaqus", {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}});
}

TEST(Anisotropic, HasNoDefaultForTheOrderOfItsIndices) {
  EXPECT_TRUE(holds(
      refusal_of(
          "{type: anisotropic, density: 1, c11: 1, c22: 1, c33: 1, c12: 0, c13: 0, c23: 0, c44: 1, c55: 1, c66: 1}"),
      "key 'voigt_order' is missing"));
}

TEST(Anisotropic, NeedsTheNineConstantsOfAnOrthotropicMaterialAndNoMore) {
  const std::string rest = "c22: 3, c33: 3, c12: 1, c13: 1, c23: 1, c44: 1, c55: 1, c66: 1}";
  const std::string start = std::string("{type: anisotropic, density: 1, voigt_order: ") + kUsual + ", ";
  EXPECT_EQ(refusal_of(start + "c11: 3, " + rest), "accepted");
  EXPECT_TRUE(holds(refusal_of(start + rest), "key 'c11' is missing"));
  EXPECT_TRUE(holds(refusal_of(start + "c11: 3, c21: 1, " + rest), "c21: unknown key; did you mean"));
  EXPECT_TRUE(holds(refusal_of(start + "c11: -3, " + rest), "c11: must be > 0 Pa"));
}

// C has ones on the diagonal and c12 = -1.5, and therefore the eigenvalues 1 -+ 1.5 and 1.
TEST(Anisotropic, AnIndefiniteSetIsRefusedWithItsEigenvalueAndStrain) {
  Mat6 C = Mat6::Identity();
  C(0, 1) = C(1, 0) = -1.5;
  const std::string message = refusal_of(input(C, kUsual));
  EXPECT_TRUE(holds(message, "smallest eigenvalue -0.5 Pa, of the strain e11=0.71, e22=0.71."));
  EXPECT_TRUE(holds(message, "times 0.6333): c12: -0.95."));  // factor (1 - 0.05) / 1.5
}

// In the usual order c45 couples the strains 23 and 13. In Mandel's notation the entries of shear are doubled.
TEST(Anisotropic, ShearStrainsAreNamedByTheirPlanes) {
  Mat6 C = Mat6::Identity();
  C(3, 4) = C(4, 3) = -2;
  EXPECT_TRUE(holds(refusal_of(input(C, kUsual)), "smallest eigenvalue -2 Pa, of the strain e23=0.50, e13=0.50."));
  EXPECT_TRUE(holds(refusal_of(input(C, kOurs)), "smallest eigenvalue -2 Pa, of the strain e12=0.50, e23=0.50."));
}

TEST(Anisotropic, ShrinkingLeavesTheSmallestUnitDiagonalEigenvalueAtTheMargin) {
  Random random(72);
  int shrunk = 0;
  for (int sample = 0; sample < 100; ++sample) {
    Mat6 C = random_positive(random);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < i; ++j) C(i, j) = C(j, i) = 3 * C(i, j);
    const AnisotropicStiffness given{C};
    if (is_stable(given)) continue;
    ++shrunk;
    const Mat6 used = shrink_couplings(given, stabilising_factor(given, 0.05)).c;
    const Vec6 scale = used.diagonal().cwiseSqrt().cwiseInverse();
    const Mat6 unit = scale.asDiagonal() * used * scale.asDiagonal();
    EXPECT_NEAR(symmetric_eigenvalues(unit)[0], 0.05, 1e-14);
    EXPECT_EQ(Vec6(used.diagonal()), Vec6(C.diagonal()));
  }
  EXPECT_GT(shrunk, 20);
}

TEST(Anisotropic, IsStableExactlyIfItsTensorIsPositiveDefinite) {
  Random random(73);
  int stable = 0;
  for (int sample = 0; sample < 300; ++sample) {
    Mat6 C = random_positive(random);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < i; ++j) C(i, j) = C(j, i) = 1.1 * C(i, j);
    const bool positive = Eigen::LLT<Mat6>(C).info() == Eigen::Success;
    EXPECT_EQ(is_stable(AnisotropicStiffness{C}), positive);
    stable += positive;
  }
  EXPECT_GT(stable, 30);
  EXPECT_LT(stable, 270);
}

}  // namespace
}  // namespace orthodyn::anisotropic_test
