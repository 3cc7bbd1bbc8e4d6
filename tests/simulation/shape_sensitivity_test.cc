// Derivatives of mode shapes with respect to numbers of a scene, against closed forms and repeated analyses.
#include "lib/simulation/sensitivity/shape_sensitivity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/sensitivity/frequency_sensitivity.h"
#include "lib/simulation/sensitivity/nelson_system.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::shape_sensitivity_test {
namespace {

const std::string kFreePlate = R"(
mesh: {type: box, size: [0.4, 0.3, 0.004], cells: [4, 3, 1], elements: hexahedra, parts: {end: {min: [0.29, 0, 0], max: [1, 1, 1]}}}
materials:
  wood: {type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.7e9, g23: 4e7, g13: 6e8}
  tip: {type: isotropic, density: 2000, young: 5e9, nu: 0.3}
regions:
  body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg}}
  end: {material: tip}
)";
const std::string kHeldPlate = kFreePlate + "clamps: [{surface: x0}]\n";

struct Analysis {
  explicit Analysis(const Config& scene, int count = 10) : setup(set_up(scene)), modal(setup, count, false) {}
  explicit Analysis(const std::string& scene, int count = 10)
      : Analysis(Config::from_text(scene + "time: {end: 1}\n", "scene.yaml"), count) {}

  ShapeSensitivities sensitivities(const std::string& path) const {
    return shape_sensitivities(setup.config, modal.model(), modal.about(), modal.modes(),
                               scene_parameters(setup.config, {path}));
  }
  const Vector& shape(std::size_t mode) const { return modal.modes().modes[mode].shape; }
  double norm(const Vector& x) const {
    Vector product(x.size());
    modal.model().multiply_mass(x, product);
    return std::sqrt(x.dot(product));
  }

  Setup setup;
  ModalAnalysis modal;
};

// All shapes of unit modal mass are proportional to 1 / sqrt(density), and independent of a common factor of moduli.
TEST(ShapeSensitivity, OfDensityAndOfAllModuliIsThatOfTheNorm) {
  const Analysis bar(R"(
mesh: {type: box, size: [0.4, 0.03, 0.02], cells: [4, 1, 1]}
materials: {m: {type: isotropic, density: 450, young: 1e9, nu: 0.3}}
)");
  const auto by_density = bar.sensitivities("materials.m.density"), by_young = bar.sensitivities("materials.m.young");
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NE(by_density.missing[k].find("0 Hz"), std::string::npos) << k;
  for (std::size_t k = 6; k < 10; ++k) {
    EXPECT_EQ(by_density.missing[k], "") << k;
    EXPECT_LE(bar.norm(by_density.by_parameter[0].derivatives[k] + bar.shape(k) / 900), 1e-7 / 900) << k;
    EXPECT_LE(bar.norm(by_young.by_parameter[0].derivatives[k]), 1e-7 / 1e9) << k;
  }
}

// Central differences of repeated analyses converge to the derivative with order two.
void expect_order_two(const std::string& text, std::size_t first, const std::string& path, const char* format,
                      double value, double si, double step) {
  const Analysis base(text);
  const auto exact = base.sensitivities(path);
  const auto shapes = [&](double at) {
    Config scene = Config::from_text(text + "time: {end: 1}\n", "scene.yaml");
    scene.set_yaml(path, fmt::format(fmt::runtime(format), at));
    const Analysis found(scene);
    std::vector<Vector> out;
    for (std::size_t k = first; k < first + 3; ++k)
      out.push_back(found.shape(k).dot(base.shape(k)) > 0 ? found.shape(k) : -found.shape(k));
    return out;
  };
  std::vector<double> errors[2];
  for (const int i : {0, 1}) {
    const double h = step / (i + 1);
    const auto after = shapes(value + h), before = shapes(value - h);
    for (std::size_t k = 0; k < 3; ++k)
      errors[i].push_back(
          base.norm((after[k] - before[k]) / (2 * h * si) - exact.by_parameter[0].derivatives[first + k]));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(exact.missing[first + k], "");
    EXPECT_NEAR(std::log2(errors[0][k] / errors[1][k]), 2, 0.3)
        << path << ", mode " << first + k << ": " << base.norm(exact.by_parameter[0].derivatives[first + k])
        << ", errors " << errors[0][k] << ", " << errors[1][k];
  }
}

TEST(ShapeSensitivity, IsTheLimitOfDifferences) {
  for (const auto& [plate, first] : {std::pair(kFreePlate, std::size_t{6}), {kHeldPlate, std::size_t{0}}}) {
    expect_order_two(plate, first, "regions.body.axes.angle", "{} deg", 20, std::numbers::pi / 180, 1);
    expect_order_two(plate, first, "materials.wood.g12", "{}", 0.7e9, 1, 0.04e9);
    expect_order_two(plate, first, "materials.tip.density", "{}", 2000, 1, 100);
    expect_order_two(plate, first, "mesh.size.2", "{}", 0.004, 1, 2e-4);
  }
}

TEST(ShapeSensitivity, IsRefusedForEqualFrequencies) {
  const std::string bar = R"(
mesh: {type: box, size: [1, 0.05, 0.05], cells: [8, 2, 2], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
)";
  const auto found = Analysis(bar, 5).sensitivities("materials.m.young");
  EXPECT_NE(found.missing[0].find("equals that of mode 2"), std::string::npos);
  EXPECT_NE(found.missing[1].find("equals that of mode 1"), std::string::npos);
  EXPECT_EQ(found.by_parameter[0].derivatives[0].size(), 0);
  EXPECT_EQ(found.missing[4], "");  // torsion
  // The only requested mode is one of two.
  EXPECT_NE(Analysis(bar, 1).sensitivities("materials.m.young").missing[0].find("equals that of mode 2"),
            std::string::npos);
}

// K - lambda M has only zeros on its diagonal, so that a factor L D L^T without pivoting does not exist.
TEST(NelsonSystem, IsSolvedWhereItHasToPivot) {
  const Eigen::Index n = 5, half = 3;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < half; ++i)
    for (Eigen::Index j = half; j < n; ++j) A(i, j) = A(j, i) = std::sin(3.0 * static_cast<double>(i * i + j));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  const Vector shape = eigen.eigenvectors().col(2);  // the eigenvalues are -s, -r, 0, r, s
  const double lambda = 0;
  ASSERT_NEAR(eigen.eigenvalues()[2], lambda, 1e-14);
  Pattern pattern{static_cast<int>(n), true, {0}, {}, {}};
  std::vector<double> K, M;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      pattern.row.push_back(static_cast<int>(i));
      K.push_back(A(i, j));
      M.push_back(i == j ? 1 : 0);
    }
    pattern.column_start.push_back(static_cast<int>(pattern.row.size()));
  }
  Vector b = Vector::LinSpaced(n, -1, 2);
  b -= shape.dot(b) * shape;
  NelsonSystem system(pattern, K, M, lambda, shape);
  const Vector z = system.solve(b);
  EXPECT_LE(((A - lambda * Eigen::MatrixXd::Identity(n, n)) * z - b).norm(), 1e-10 * b.norm());
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  EXPECT_EQ(z[largest], 0);
}

class ShapeSensitivityFiles : public InFolder {};

// Shapes of unit modal mass are proportional to 1 / sqrt(density).
TEST_F(ShapeSensitivityFiles, AreFieldsOfTheShapesAndValuesAtProbes) {
  write("bar.yaml", R"(
mesh: {type: box, size: [1, 0.05, 0.03], cells: [8, 1, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
time: {end: 1}
output: {probes: {tip: {at: [1, 0, 0]}}}
)");
  const std::string modes = "modes bar.yaml -n 3 --out out --force ";
  const auto result =
      orthodyn(modes + "--shape-sensitivities --sensitivity materials.m.young --sensitivity materials.m.density");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto fields = read_fields<double>(folder_ / "out/modes/mode_002.vtu");
  ASSERT_EQ(fields.count("d shape / d materials.m.young"), 1u);
  const auto &shape = fields.at("shape"), &slope = fields.at("d shape / d materials.m.density");
  ASSERT_EQ(shape.size(), slope.size());
  for (std::size_t i = 0; i < shape.size(); ++i) EXPECT_NEAR(slope[i], -shape[i] / 2000, 1e-7 / 2000) << i;
  const auto rows = read_rows(folder_ / "out/shape_sensitivities.csv");
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 2u + 3 * 3);
    double largest = 0;
    for (const std::size_t at : {2, 5, 8}) largest = std::max(largest, std::abs(row[at]));
    EXPECT_GT(largest, 0);
    for (const std::size_t at : {2, 5, 8}) EXPECT_NEAR(row[at + 2], -row[at] / 2000, 1e-6 * largest / 2000);
  }
  EXPECT_NE(read_text(folder_ / "out/shape_sensitivities.csv")
                .find("tip.shape.x [1/sqrt(kg)],d tip.shape.x / d materials.m.young [1/sqrt(kg) / SI unit]"),
            std::string::npos);
  EXPECT_EQ(orthodyn(modes).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/shape_sensitivities.csv"));
}

TEST_F(ShapeSensitivityFiles, NameModesWithoutDerivativesAndNeedAParameter) {
  write("bar.yaml", R"(
mesh: {type: box, size: [1, 0.05, 0.05], cells: [8, 2, 2], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
time: {end: 1}
)");
  const auto equal = orthodyn("modes bar.yaml -n 2 --out out --shape-sensitivities --sensitivity materials.m.young");
  EXPECT_EQ(equal.exit_code, 0) << equal.output;
  EXPECT_NE(equal.output.find("mode 2 has no derivative: its frequency equals that of mode 1"), std::string::npos)
      << equal.output;
  const auto without = orthodyn("modes bar.yaml --out other --shape-sensitivities");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.output.find("add --sensitivity PATH"), std::string::npos) << without.output;
}

}  // namespace
}  // namespace orthodyn::shape_sensitivity_test
