// The mixed formulation: derivatives, work between two states, rigid motions, constant stress, and the inf-sup
// condition.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::mixed_formulation_test {
namespace {

struct Kind {
  const char* name;
  BoxMesh::Elements elements;
  bool centres;   // nodes in the middle of quadrilaterals and hexahedra
  int pressures;  // per element
  bool is_linear = false;
};
void PrintTo(const Kind& kind, std::ostream* os) { *os << kind.name; }

constexpr Kind kKinds[] = {
    {"tet10", BoxMesh::Elements::tetrahedra, false, 1},   {"hex20", BoxMesh::Elements::hexahedra, false, 4},
    {"hex27", BoxMesh::Elements::hexahedra, true, 4},     {"wedge15", BoxMesh::Elements::wedges, false, 1},
    {"wedge18", BoxMesh::Elements::wedges, true, 1},      {"hex8", BoxMesh::Elements::hexahedra, false, 1, true},
    {"wedge6", BoxMesh::Elements::wedges, false, 1, true}};

std::string isotropic(double nu, double shear = 1) {
  return fmt::format("{{type: isotropic, density: 1, young: {}, nu: {}}}", 2 * (1 + nu) * shear, nu);
}
// Four times as stiff along axis 1; bulk modulus 5000 / 3 Pa.
const std::string kFibres =
    "{type: orthotropic, density: 1, young: [4, 1, 1], nu12: 0.4999, nu23: 0.874825, nu31: 0.124975, g12: 0.4, g23: "
    "0.3, g13: 0.5}";

bool is_inner(const Vec3& x) { return (x.array() > 1e-9).all() && (x.array() < 1 - 1e-9).all(); }

// The unit cube in `cells` per side, with inner corners moved at random.
Mesh cube(const Kind& kind, int cells, double distortion) {
  Mesh mesh = make_box({.size = Vec3::Ones(), .cells = {cells, cells, cells}, .elements = kind.elements});
  Random random(701);
  for (Vec3& x : mesh.nodes)
    if (is_inner(x)) x += distortion * random.vector();
  if (!kind.is_linear) make_quadratic(mesh);
  if (kind.centres) add_centres(mesh);
  validate(mesh, {"cube"});
  return mesh;
}

BuiltTestScene scene_of(const Mesh& mesh, const std::string& material, const std::string& more = "") {
  given_mesh() = mesh;
  return BuiltTestScene(
      fmt::format("mesh: {{type: given}}\nmaterials: {{m: {}}}\nregions: {{body: {{material: m, "
                  "formulation: mixed, axes: {}}}}}\ntime: {{end: 1}}\n{}",
                  material, kTurnedAxes, more));
}

class Mixed : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kind, Mixed, testing::ValuesIn(kKinds), [](const auto& one) { return one.param.name; });

constexpr const char* kKinematics[] = {"corotational", "linear"};
std::string with_kinematics(const char* kinematics) {
  return fmt::format("elasticity: {{kinematics: {}}}\n", kinematics);
}

double order(double error, double error_of_half) { return std::log2(error / error_of_half); }

// The force is minus the derivative of the energy, and the stiffness is minus the derivative of the force. Central
// differences have an error of order 2 in the step.
TEST_P(Mixed, HasExactDerivatives) {
  for (const char* kinematics : kKinematics)
    for (const std::string& material : {isotropic(0.4999), kFibres}) {
      const BuiltTestScene s =
          scene_of(cube(GetParam(), 2, 0.05), material, with_kinematics(kinematics) + "clamps: [{surface: x0}]");
      Random random(702);
      const Vector q = random_dofs(random, s.size(), 0.02), d = random_dofs(random, s.size(), 1);
      const Vector slope = -s.stiffness(q) * d;
      const auto error = [&](double h) {
        return ((s.force(q + h * d) - s.force(q - h * d)) / (2 * h) - slope).norm() / slope.norm();
      };
      const auto energy_error = [&](double h) {
        return std::abs((s.potential(q + h * d) - s.potential(q - h * d)) / (2 * h) + s.force(q).dot(d)) /
               s.potential(q);
      };
      if (std::string_view(kinematics) == "linear") {
        EXPECT_LT(error(0.1), 1e-11);
        EXPECT_LT(energy_error(0.1), 1e-9);
      } else {
        EXPECT_NEAR(order(error(2e-3), error(1e-3)), 2, 0.2);
        EXPECT_NEAR(order(energy_error(4e-3), energy_error(2e-3)), 2, 0.2);
      }
    }
}

// Stiffness and force of elements without batch version: some are inverted.
TEST_P(Mixed, HasAForceThatIsTheDerivativeOfTheEnergyWithInvertedElements) {
  const BuiltTestScene s = scene_of(cube(GetParam(), 2, 0.05), isotropic(0.4999));
  Random random(703);
  const Mat3 mirror = Vec3(1, 1, -1).asDiagonal();
  const Vector q = s.dofs([&](const Vec3& x) { return x[0] < 0.5 ? Vec3(mirror * x - x) : Vec3(Vec3::Zero()); }) +
                   random_dofs(random, s.size(), 0.01);
  const Vector d = random_dofs(random, s.size(), 1);
  ASSERT_LT(s.scalar("det_f.smallest", q, s.zero()), 0);
  const auto error = [&](double h) {
    return std::abs((s.potential(q + h * d) - s.potential(q - h * d)) / (2 * h) + s.force(q).dot(d));
  };
  EXPECT_NEAR(order(error(6e-4), error(3e-4)), 2, 0.1);
}

// The damping matrix is minus the derivative of the force by the velocity, and the power is the dissipation.
TEST_P(Mixed, HasAViscousForceOfTheProjectedRate) {
  for (const char* kinematics : kKinematics) {
    const BuiltTestScene s =
        scene_of(cube(GetParam(), 2, 0.05), kFibres, with_kinematics(kinematics) + "damping: {stiffness: 0.1}");
    Random random(704);
    const Vector q = random_dofs(random, s.size(), 0.02), v = random_dofs(random, s.size(), 1);
    const Vector viscous = s.force(q, v) - s.force(q);
    EXPECT_LT((viscous + s.matrix({0, 1, 0}, q, v) * v).norm(), 1e-11 * viscous.norm());
    EXPECT_NEAR(s.scalar("power.dissipated", q, v), -viscous.dot(v), 1e-11 * std::abs(viscous.dot(v)));
  }
}

TEST_P(Mixed, HasAMeanForceThatDoesTheWorkAndNoTorque) {
  for (const std::string& material : {isotropic(0.4999), kFibres}) {
    const BuiltTestScene s = scene_of(cube(GetParam(), 1, 0), material);
    Random random(705);
    const auto turned = [&](double angle, double strain) {
      const Mat3 R = Eigen::AngleAxisd(angle, Vec3(1, 2, -1).normalized()).toRotationMatrix();
      const Mat3 stretch = Vec3(1 + strain, 1 - 0.5 * strain, 1).asDiagonal();
      return Vector(s.dofs([&](const Vec3& X) { return Vec3(R * stretch * X - X); }) +
                    random_dofs(random, s.size(), 0.02));
    };
    const Vector q0 = turned(0.3, 0.1), q1 = turned(0.9, -0.05);
    Vector f(s.size());
    s.model().discrete_gradient()->mean_force(0, q0, 0.1, q1, s.zero(), f);
    const double scale = s.potential(q0) + s.potential(q1) + (f.array() * (q1 - q0).array()).abs().sum();
    EXPECT_NEAR(f.dot(q1 - q0), s.potential(q0) - s.potential(q1), 1e-12 * scale);
    const NodalVector forces = s.nodal(f), x = 0.5 * (s.positions(q0) + s.positions(q1));
    Vec3 torque = Vec3::Zero();
    for (Eigen::Index n = 0; n < x.cols(); ++n) torque += Vec3(x.col(n)).cross(Vec3(forces.col(n)));
    EXPECT_LT(torque.norm(), 1e-12 * forces.norm());
  }
}

TEST_P(Mixed, HasNoForceInRigidMotionsAndNoOtherMotionWithoutForce) {
  const BuiltTestScene s = scene_of(cube(GetParam(), 2, 0.05), kFibres);
  Random random(706);
  const Mat3 R = random.rotation();
  EXPECT_LT(s.force(s.dofs([&](const Vec3& x) { return Vec3(R * x - x); })).norm(), 1e-9);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s.stiffness(s.zero())).eigenvalues();
  EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-12 * values[values.size() - 1]);
  EXPECT_GT(values[6], 1e-4);
}

// If the displacement is linear in the position, the stress is uniform, also in distorted elements. At small strain the
// mixed and the displacement formulation have the same stress.
TEST_P(Mixed, PassesThePatchTest) {
  Random random(707);
  const Mat3 A = 0.01 * random.matrix();
  for (const char* kinematics : kKinematics) {
    const BuiltTestScene s = scene_of(cube(GetParam(), 3, 0.05), kFibres, with_kinematics(kinematics));
    given_mesh() = s.mesh();
    const BuiltTestScene plain(
        fmt::format("mesh: {{type: given}}\nmaterials: {{m: {}}}\nregions: {{body: {{material: "
                    "m, formulation: displacement, axes: {}}}}}\ntime: {{end: 1}}\n{}",
                    kFibres, kTurnedAxes, with_kinematics(kinematics)));
    const Vector q = s.dofs([&](const Vec3& x) { return Vec3(A * x); });
    const NodalVector f = s.nodal(s.force(q));
    for (Eigen::Index n = 0; n < f.cols(); ++n)
      if (is_inner(s.model().parts().rest->col(n))) {
        EXPECT_LE(f.col(n).norm(), 1e-11);
      }
    for (const char* field : {"stress", "nodal_stress"}) {
      const auto mixed = s.model().evaluate(field, {0, q, s.zero()});
      const auto expected = plain.model().evaluate(field, {0, q, s.zero()});
      ASSERT_EQ(mixed.size(), expected.size());
      const bool is_linear = std::string_view(kinematics) == "linear";
      for (std::size_t k = 0; k < mixed.size(); ++k)
        EXPECT_NEAR(mixed[k], is_linear ? expected[k] : mixed[k % 6], 1e-9) << field;
    }
  }
}

// Also in strongly compressed elements, which have no batch version.
TEST_P(Mixed, ObservesTheSameOfAllPointsAndOfOne) {
  for (const double stretch : {0.15, 0.9}) {
    const BuiltTestScene s = scene_of(cube(GetParam(), 1, 0), kFibres);
    Random random(708);
    const Vector q =
        s.dofs([&](const Vec3& x) { return Vec3((stretch - 1) * x); }) + random_dofs(random, s.size(), 0.01 * stretch);
    const NodalExpansion nodal(s.model().parts(), 0, q, s.zero());
    const ElasticTerm& term = *s.model().parts().elastic.front();
    int visited = 0;
    term.observe_points(nodal.state(), [&](int k, int p, const PointObservation& all) {
      const Mat3 one = term.observe_point(k, p, nodal.state()).cauchy;
      EXPECT_LT((all.cauchy - one).norm(), 1e-9 * one.norm()) << stretch;
      ++visited;
    });
    EXPECT_EQ(visited, term.size() * term.num_points());
  }
}

// Stresses predicted from a state for this same state are its own, so that the tangent is the exact one.
TEST_P(Mixed, HasTheExactTangentWithStressesPredictedFromTheSameState) {
  const BuiltTestScene s = scene_of(cube(GetParam(), 1, 0), kFibres);
  Random random(709);
  const Vector q = random_dofs(random, s.size(), 0.05);
  const NodalExpansion nodal(s.model().parts(), 0, q, s.zero());
  const ElasticTerm& term = *s.model().parts().elastic.front();
  std::vector<double> exact(s.model().pattern().row.size(), 0), predicted = exact;
  term.add_tangent(nodal.state(), TangentKind::exact, exact.data(), nullptr);
  term.add_predicted_tangent(nodal.state(), nodal.state(), predicted.data());
  const Eigen::Map<const Vector> a(exact.data(), std::ssize(exact)), b(predicted.data(), std::ssize(predicted));
  EXPECT_LT((a - b).norm(), 1e-11 * a.norm());
}

// With a held surface, min over pressures p without constant part of max over u of (p, div u)^2 / (|p|^2 |u|^2), |u|
// the norm of the deviatoric energy. Elements satisfy the inf-sup condition if this number does not tend to zero with
// the cell size (Chapelle & Bathe 1993, Comput. Struct. 47, 537); without the condition it does, or pressures without
// force exist. The matrix of (div u)^2 follows from the stiffnesses of two bulk moduli.
struct InfSup {
  double beta;
  int without_force;  // pressures that act on no displacement
};
InfSup inf_sup(const Kind& kind, int cells) {
  const std::string held =
      "clamps: [{surface: x0}, {surface: x1}, {surface: y0}, {surface: y1}, {surface: z0}, {surface: z1}]\n"
      "elasticity: {kinematics: linear}\n";
  const Mesh mesh = cube(kind, cells, 0.1 / cells);
  const double bulk[] = {8, 16};  // with a shear modulus of 1, above the part that elements may keep
  const auto nu = [](double kappa) { return (3 * kappa - 2) / (6 * kappa + 2); };
  const BuiltTestScene one = scene_of(mesh, isotropic(nu(bulk[0])), held);
  const BuiltTestScene two = scene_of(mesh, isotropic(nu(bulk[1])), held);
  const Eigen::MatrixXd K1 = one.stiffness(one.zero()), K2 = two.stiffness(two.zero());
  const Eigen::MatrixXd D = (K2 - K1) / (bulk[1] - bulk[0]);
  const Eigen::VectorXd squares =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(D, K1 - bulk[0] * D, Eigen::EigenvaluesOnly)
          .eigenvalues();
  constexpr double kZero = 1e-9;
  const auto pressures = kind.pressures * static_cast<int>(mesh.cells.size());
  const auto acting = static_cast<int>((squares.array() > kZero).count());
  return {std::sqrt(squares[squares.size() - acting]), pressures - acting};
}

// The other elements do not: their number falls with the cell size, and tetrahedra have pressures without force.
TEST(StableMixed, SatisfiesTheInfSupCondition) {
  for (const Kind& kind : kKinds) {
    if (!kind.centres) continue;
    const InfSup coarse = inf_sup(kind, 2), fine = inf_sup(kind, 4);
    EXPECT_EQ(coarse.without_force, 1) << kind.name;  // the constant pressure
    EXPECT_EQ(fine.without_force, 1) << kind.name;
    EXPECT_GT(fine.beta, 0.35) << kind.name;
    EXPECT_GT(fine.beta, 0.9 * coarse.beta) << kind.name;
  }
}

}  // namespace
}  // namespace orthodyn::mixed_formulation_test
