// Parts of the force: their names, and their sum is the whole force.
#include <gtest/gtest.h>

#include "tests/fem/built_scene.h"

namespace orthodyn::part_model_test {
namespace {

const BuiltTestScene& scene() {
  static const BuiltTestScene built(R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1], order: 1}
materials: {wood: {type: orthotropic_stable, density: 1000, young: [2e6, 2e5, 1e5], nu: 0.3}}
regions: {all: {material: wood, axes: {first: [0.8, 0.6, 0], second: [-0.6, 0.8, 0]}}}
gravity: [0, 0, -4]
damping: {stiffness: 0.005, mass: 2}
clamps: [{surface: x0}]
loads:
  - {surface: x1, traction: [0, 10, 0]}
  - {surface: x1, force: [0, 0, 1], factor: {type: ramp, end: 1}}
time: {end: 0.5}
)");
  return built;
}

Vector some(double seed) {
  Vector x(scene().size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 0.01 * std::sin(seed + 7.0 * static_cast<double>(i));
  return x;
}

Vector force_of(const Model& model, double t, const Vector& q, const Vector& v) {
  Vector f(q.size());
  model.force(t, q, v, f);
  return f;
}

std::vector<double> combined(const Model& model, const Weights& w, const Vector& q, const Vector& v) {
  Linearization at;
  model.linearize(0.5, q, v, TangentKind::exact, at);
  std::vector<double> values(model.pattern().row.size());
  model.combine(w, at, values.data());
  return values;
}

TEST(ForceParts, HaveTheNamesOfTheirTerms) {
  const std::vector<std::string> expected = {"elasticity of region body", "gravity", "traction on x1",
                                             "traction on x1 (2)", "mass damping"};
  EXPECT_EQ(scene().model().force_parts(), expected);
}

TEST(ForceParts, AddUpToTheWholeForce) {
  const Vector q = some(1), v = some(2), whole = force_of(scene().model(), 0.5, q, v);
  Vector sum = Vector::Zero(q.size());
  for (const auto& name : scene().model().force_parts()) sum += force_of(*scene().model().only({name}), 0.5, q, v);
  EXPECT_LE((sum - whole).norm(), 1e-13 * whole.norm());
}

// With the mass once in each.
// A consistent mass lets moved nodes pull on free ones.
TEST(ForceParts, AddUpToTheWholeForceOnMovedSupports) {
  const BuiltTestScene moved(R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1], order: 1}
materials: {wood: {type: orthotropic_stable, density: 1000, young: [2e6, 2e5, 1e5], nu: 0.3}}
regions: {all: {material: wood}}
mass: consistent
damping: {mass: 2}
motions: [{surface: x0, translation: [0, 0, 0.1], factor: {type: smooth_step, end: 1}}]
time: {end: 1}
)");
  const Model& model = moved.model();
  const Vector q = 1e-3 * Vector::LinSpaced(moved.size(), -1, 2), v = 2 * q, whole = force_of(model, 0.3, q, v);
  Vector sum = Vector::Zero(q.size());
  for (const auto& name : model.force_parts()) sum += force_of(*model.only({name}), 0.3, q, v);
  EXPECT_EQ(model.force_parts().back(), "pull of moved supports");
  EXPECT_LE((sum - whole).norm(), 1e-13 * whole.norm());
}

TEST(ForceParts, AddUpToTheWholeMatrix) {
  const Vector q = some(1), v = some(2);
  const auto whole = combined(scene().model(), {0, 3, 2}, q, v);
  std::vector<double> sum(whole.size(), 0);
  double largest = 0;
  for (const auto& name : scene().model().force_parts()) {
    const auto part = combined(*scene().model().only({name}), {0, 3, 2}, q, v);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
  }
  for (const double x : whole) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < sum.size(); ++k) EXPECT_NEAR(sum[k], whole[k], 1e-13 * largest);
}

TEST(ForceParts, HaveTheWholeMass) {
  const auto part = scene().model().only({"gravity"});
  const Vector q = some(1);
  EXPECT_EQ(combined(*part, {1, 0, 0}, q, q), combined(scene().model(), {1, 0, 0}, q, q));
}

}  // namespace
}  // namespace orthodyn::part_model_test
