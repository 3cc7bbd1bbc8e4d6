// Nodal stresses and mesh error estimates from recovered stresses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/simulation/error_estimate/error_balance.h"
#include "tests/problems/running.h"

namespace orthodyn::stress_recovery_test {
namespace {

// A box with distorted cells and one or two regions at small strain.
BuiltTestScene box(int order, bool two_regions = false, double thickness = 1) {
  Mesh mesh = make_box({.cells = {3, 3, 3}, .split = BoxMesh::Split::six});
  Random random(511);
  for (Vec3& x : mesh.nodes)
    if ((x.array() > 0.01).all() && (x.array() < 0.99).all()) x += 0.05 * random.vector();
  if (two_regions) {
    mesh.region_names = {"soft", "stiff"};
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      mesh.region_of[c] = centroid(mesh, static_cast<int>(c))[0] > 0.5 ? 1 : 0;
  }
  const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  if (thickness != 1)
    for (Vec3& x : mesh.nodes) x = turned * Vec3(x[0], x[1], thickness * x[2]);
  if (order == 2) make_quadratic(mesh);
  given_mesh() = mesh;
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: given}}
materials:
  m: {{type: orthotropic, density: 1, young: [10, 1, 0.5], nu12: 0.4, nu23: 0.4, nu31: 0.02, g12: 0.7, g23: 0.1, g13: 0.6}}
  soft: {{type: isotropic, density: 1, young: 1, nu: 0}}
  stiff: {{type: isotropic, density: 1, young: 3, nu: 0}}
regions: {}
elasticity: {{kinematics: linear}}
mass: consistent
time: {{end: 1}}
)",
                                    two_regions ? "{soft: {material: soft}, stiff: {material: stiff}}"
                                                : fmt::format("{{all: {{material: m, axes: {}}}}}", kTurnedAxes)));
}

std::vector<double> nodal_strain(const BuiltTestScene& s, const Vector& q) {
  return s.model().evaluate("nodal_strain", {0, q, s.zero()});
}

struct Body {
  int order;
  double thickness;  // of its width
};

class Recovery : public testing::TestWithParam<Body> {};
INSTANTIATE_TEST_SUITE_P(Order, Recovery,
                         testing::Values(Body{1, 1}, Body{2, 1}, Body{1, 1e-2}, Body{2, 1e-2}, Body{2, 1e-3}),
                         [](const auto& body) {
                           return fmt::format("{}_{}", body.param.order, std::round(1 / body.param.thickness));
                         });

// A strain field in the element's polynomial space is recovered exactly at every node, including the surface, with zero
// estimated error; also in inclined plates.
TEST_P(Recovery, IsExactForTheStrainsThatElementsHold) {
  const auto [order, thickness] = GetParam();
  const BuiltTestScene s = box(order, false, thickness);
  Random random(512);
  const Mat3 A = random.matrix(), B = random.matrix() * (order - 1.0);
  const auto u = [&](const Vec3& x) { return Vec3(A * x + x[0] * B * x); };
  const auto gradient = [&](const Vec3& x) { return Mat3(A + x[0] * B + B * x * Vec3::UnitX().transpose()); };
  const Vector q = s.dofs(u);
  const auto values = nodal_strain(s, q);
  const Mat3 Q = s.model().parts().elastic.front()->axes_at_rest(0, 0);
  for (Eigen::Index n = 0; n < s.model().parts().rest->cols(); ++n) {
    const Mat3 H = gradient(s.model().parts().rest->col(n)), e = Q.transpose() * 0.5 * (H + H.transpose()) * Q;
    const double* found = values.data() + 6 * n;
    const double expected[] = {e(0, 0), e(1, 1), e(2, 2), e(0, 1), e(1, 2), e(2, 0)};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], 1e-11 / thickness);
  }
  const auto energy = s.model().evaluate("energy.mesh_error", {0, q, s.zero()});
  EXPECT_LE(energy[0], 1e-20 * energy[1]);
  EXPECT_NEAR(energy[1], s.model().evaluate("energy.elastic", {0, q, s.zero()})[0], 1e-12 * energy[1]);
}

// The strain of a bent bar is linear: exact with quadratic elements; with linear ones, most of the energy is error.
TEST(MeshError, IsThatOfElementsThatCannotHoldTheStrain) {
  const auto relative = [](int order) {
    const BuiltTestScene s = box(order);
    const auto u = [](const Vec3& x) { return Vec3(x[0] * x[2], 0, -x[0] * x[0] / 2); };
    const auto energy = s.model().evaluate("energy.mesh_error", {0, s.dofs(u), s.zero()});
    return energy[0] / energy[1];
  };
  EXPECT_GT(relative(1), 0.01);
  EXPECT_LE(relative(2), 1e-20);
}

// Elements of different curvature: the result does not depend on their order.
TEST(MeshError, OfCurvedElementsDoesNotDependOnTheirOrder) {
  const auto u = [](const Vec3& x) { return Vec3(x[0] * x[1] * x[1], x[2] * x[2] * x[2], -x[0] * x[0] / 2); };
  const BuiltTestScene straight = box(2);
  const std::string yaml = R"(
mesh: {type: given}
materials: {m: {type: isotropic, density: 1, young: 1, nu: 0.3}}
regions: {all: {material: m}}
elasticity: {kinematics: linear}
mass: consistent
time: {end: 1}
)";
  Mesh mesh = straight.mesh();
  Random random(77);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int node : mesh.cells[c].subspan(4))
      mesh.nodes[static_cast<std::size_t>(node)] += 0.01 * random.vector();
  given_mesh() = mesh;
  const BuiltTestScene first(yaml);
  Cells from_the_last;
  for (std::size_t c = mesh.cells.size(); c-- > 0;) from_the_last.add(mesh.cells.shape(c), mesh.cells[c]);
  mesh.cells = from_the_last;
  given_mesh() = mesh;
  const BuiltTestScene second(yaml);
  const auto of = [&](const BuiltTestScene& s, const char* name) {
    return s.model().evaluate(name, {0, s.dofs(u), s.zero()});
  };
  auto field = of(first, "mesh_error"), reversed = of(second, "mesh_error");
  std::reverse(reversed.begin(), reversed.end());
  const double largest = *std::max_element(field.begin(), field.end());
  for (std::size_t k = 0; k < field.size(); ++k) EXPECT_NEAR(reversed[k], field[k], 1e-10 * largest);
  const auto energy = of(first, "energy.mesh_error"), again = of(second, "energy.mesh_error");
  for (std::size_t k = 0; k < energy.size(); ++k) EXPECT_NEAR(again[k], energy[k], 1e-10 * energy[k]);
}

// Uniform strain with stress jumps between regions: each region is recovered separately, with zero estimated error.
TEST(MeshError, KnowsThatStressesJumpBetweenRegions) {
  const BuiltTestScene s = box(1, true);
  const Vector q = s.dofs([](const Vec3& x) { return Vec3(x[0], 0, 0); });
  const State state{0, q, s.zero()};
  const auto energy = s.model().evaluate("energy.mesh_error", state);
  EXPECT_LE(energy[0], 1e-20 * energy[1]);

  // Nodes of one region have its stress, E times the strain; shared nodes have the mean.
  const auto& mesh = s.mesh();
  std::vector<int> seen(mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int node : mesh.cells[c]) seen[static_cast<std::size_t>(node)] |= 1 << mesh.region_of[c];
  const auto stress = s.model().evaluate("nodal_stress_material", state);
  for (std::size_t n = 0; n < seen.size(); ++n)
    EXPECT_NEAR(stress[6 * n], seen[n] == 1 ? 1 : seen[n] == 2 ? 3 : 2, 1e-11);
}

RunResult moved(int order, double mesh, std::optional<double> accumulated, double rtol) {
  RunResult result;
  result.model.order = order;
  result.motion.emplace();
  result.motion->mesh_error = MeshError{mesh, 5};
  result.motion->rtol = rtol;
  if (accumulated) result.motion->segment_error.emplace().error = *accumulated;
  return result;
}

TEST(ErrorBalance, TellsTheLargerErrorAndWhatToChange) {
  const auto advice = [](const RunResult& result) { return error_balance(result)->advice; };
  using testing::AllOf, testing::HasSubstr, testing::Not;
  EXPECT_THAT(advice(moved(1, 0.3, 1e-4, 1e-4)),
              AllOf(HasSubstr("the mesh dominates"), HasSubstr("mesh.order: 2"), HasSubstr("rtol 1e-02")));
  EXPECT_THAT(advice(moved(2, 0.1, 1e-3, 1e-5)),
              AllOf(HasSubstr("the mesh dominates"), HasSubstr("finer cells"), HasSubstr("rtol 1e-04")));
  EXPECT_THAT(advice(moved(2, 0.1, 0.02, 1e-5)), AllOf(HasSubstr("the mesh dominates"), Not(HasSubstr("rtol"))));
  EXPECT_THAT(advice(moved(1, 0.001, 0.02, 1e-3)),
              AllOf(HasSubstr("the integration dominates"), HasSubstr("integrator.rtol")));
  EXPECT_EQ(advice(moved(1, 0.01, 0.02, 1e-3)), "");
  EXPECT_THAT(advice(moved(1, 0.1, std::nullopt, 1e-3)), HasSubstr("mesh.order: 2"));
  EXPECT_EQ(advice(moved(1, 1e-3, std::nullopt, 1e-3)), "");
}

// With a model, only the state with the largest elastic energy is evaluated.
TEST(MeshError, OfTheMostDeformedState) {
  const BuiltTestScene s = box(1);
  const auto bent = [&](double size) { return s.dofs([&](const Vec3& X) { return Vec3(0, size * X[0] * X[0], 0); }); };
  const State small{0, bent(0.01), s.zero()}, large{1, bent(0.03), s.zero()};
  MeshErrorRecorder one(1), of_all(3, &s.model());
  one.on_output({s.model(), large});
  for (const State* state : {&small, &large, &small}) of_all.on_output({s.model(), *state});
  ASSERT_TRUE(one.found() && of_all.found());
  EXPECT_GT(one.found()->relative, 0.01);
  EXPECT_DOUBLE_EQ(of_all.found()->relative, one.found()->relative);
  EXPECT_EQ(of_all.found()->samples, 1);
  EXPECT_EQ(of_all.most_deformed()->t, 1);
}

TEST(MeshError, OfARigidMotionIsNotTold) {
  const BuiltTestScene s = box(1);
  const Vector still = s.zero(), v = s.dofs([](const Vec3&) { return Vec3(1, 2, 3); });
  MeshErrorRecorder recorder(1);
  const State state{0, still, v};
  recorder.on_output({s.model(), state});
  EXPECT_FALSE(recorder.found());
}

}  // namespace
}  // namespace orthodyn::stress_recovery_test
