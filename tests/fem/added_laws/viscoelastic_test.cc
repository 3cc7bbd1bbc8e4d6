// Viscoelastic bodies: forces, energies and their derivatives, at equilibrium, with given internal variables and along
// a history.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/ode/internal_history.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::viscoelastic_test {
namespace {

constexpr double kFast = 0.1, kSlow = 3;

std::string block(const std::string& branches, const std::string& more = "", const std::string& mesh = "order: 1",
                  const std::string& young = "[10, 1, 2]") {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.8, 0.6], cells: [2, 1, 1], {}}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: {}, nu: 0.3{}}}}}
regions: {{all: {{material: m, axes: {}}}}}
clamps: [{{surface: x0}}]
time: {{end: 2}}
{}
)",
                     mesh, young, branches.empty() ? "" : ", viscoelastic: " + branches, kTurnedAxes, more);
}

const std::string kTwoBranches = "[{time: 0.1, share: 0.3}, {time: 3, normal: [0.1, 0.4, 0], shear: [0.2, 0.6, 0.1]}]";

struct Body {
  explicit Body(const std::string& yaml) : s(yaml), internal(*s.model().internal_variables()) {}

  Vector random_internals(Random& random) const { return random_dofs(random, internal.size(), 0.1); }
  Vector strains(const Vector& q) const {
    Vector e(internal.size());
    internal.strains(0, q, e);
    return e;
  }
  Vector force(const Vector& q, const InternalState& z) const {
    Vector f(s.size());
    internal.force(0, q, s.zero(), z, f);
    return f;
  }
  Vector force(const Vector& q, const Vector& z) const { return force(q, {InternalState::Kind::given, z.data(), 0}); }
  Eigen::MatrixXd stiffness(const Vector& q, const InternalState& z, TangentKind kind = TangentKind::exact) const {
    Linearization at;
    internal.assemble(0, q, s.zero(), z, kind, at);
    std::vector<double> values(s.model().pattern().row.size());
    s.model().combine({0, 0, 1}, at, values.data());
    Eigen::MatrixXd K(s.size(), s.size());
    for (int j = 0; j < s.size(); ++j) {
      Vector y(s.size());
      s.model().multiply_matrix(values.data(), Vector::Unit(s.size(), j), y);
      K.col(j) = y;
    }
    return K;
  }
  double output(const char* name, const Vector& q, const Vector& z) const {
    return s.model().evaluate(name, {0, q, s.zero(), 1, z})[0];
  }

  BuiltTestScene s;
  const InternalVariables& internal;
};

const std::vector<std::string> kKinematics{"corotational", "linear"};
std::string kinematics(const std::string& name) { return "elasticity: {kinematics: " + name + "}"; }

class Meshes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Viscoelastic, Meshes,
                         testing::Values("order: 1", "order: 2", "elements: hexahedra, order: 1",
                                         "elements: hexahedra, order: 2", "elements: wedges, order: 1",
                                         "elements: wedges, order: 2"));

// With a share common to all constants, the relaxed body is an elastic one with a multiple of the stiffness.
TEST_P(Meshes, RelaxedIsElasticWithTheRelaxedStiffness) {
  for (const std::string& name : kKinematics) {
    const Body body(
        block("[{time: 0.1, share: 0.3}, {time: 3, share: 0.2}]", kinematics(name), GetParam(), "[10, 1, 2]"));
    const BuiltTestScene soft(block("", kinematics(name), GetParam(), "[5, 0.5, 1]"));
    Random random(411);
    const Vector q = random_dofs(random, body.s.size(), 0.05);
    const Vector f = soft.force(q);
    EXPECT_GE(f.norm(), 1e-3);
    EXPECT_LE((body.s.force(q) - f).norm(), 1e-13 * f.norm());
    EXPECT_LE((body.force(q, body.strains(q)) - f).norm(), 1e-13 * f.norm());
    const Eigen::MatrixXd K = soft.stiffness(q);
    EXPECT_LE((body.s.stiffness(q) - K).norm(), 1e-12 * K.norm());
    for (const char* field : {"energy.elastic", "nodal_stress"}) {
      const auto relaxed = body.s.model().evaluate(field, {0, q, body.s.zero(), 1, body.strains(q)});
      const auto expected = soft.model().evaluate(field, {0, q, soft.zero()});
      double largest = 0;
      for (const double x : expected) largest = std::max(largest, std::abs(x));
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(relaxed[i], expected[i], 1e-12 * largest) << field;
    }
  }
}

// Each constant relaxes by its share: E1 of the bar of a material without Poisson's ratios.
TEST(Viscoelastic, SharesOfConstantsAreThoseOfTheStiffness) {
  const PronyBranch branch{1, {}, Vec3(0.1, 0.4, 0), Vec3(0.2, 0.6, 0.1), {}, {}};
  Mat6 C = Mat6::Zero();
  C.diagonal() << 10, 1, 2, 3, 4, 5;
  C(0, 1) = C(1, 0) = 0.5;
  Vec6 expected;
  expected << 1, 0.4, 0, 0.6, 2.4, 0.5;
  EXPECT_LE((branch.stiffness(C).diagonal() - expected).norm(), 1e-15);
  EXPECT_NEAR(branch.stiffness(C)(0, 1), std::sqrt(0.1 * 0.4) * 0.5, 1e-15);
  const Mat6 isotropic = voigt(isotropic_stiffness(1, 0.3));
  const auto volume_of = [](const Mat6& c) { return c.topLeftCorner(3, 3).sum(); };
  const double volume_stiffness = volume_of(isotropic) / 9;
  const PronyBranch of_shear{1, {}, {}, {}, 0.5, {}}, of_bulk{1, {}, {}, {}, {}, 0.5};
  EXPECT_NEAR(of_shear.stiffness(isotropic)(3, 3), 0.5 * isotropic(3, 3), 1e-15);
  EXPECT_NEAR(volume_of(of_shear.stiffness(isotropic)), 0, 1e-15);
  EXPECT_NEAR(of_bulk.stiffness(isotropic)(3, 3), 0, 1e-15);
  EXPECT_NEAR(of_bulk.stiffness(isotropic)(0, 0), 0.5 * volume_stiffness, 1e-15);
}

TEST_P(Meshes, ForceIsTheGradientOfTheEnergyAtFixedInternalVariables) {
  for (const std::string& name : kKinematics) {
    const Body body(block(kTwoBranches, kinematics(name), GetParam()));
    Random random(412);
    const Vector q = random_dofs(random, body.s.size(), 0.03), dq = random_dofs(random, body.s.size(), 1),
                 z = body.random_internals(random);
    expect_derivative([&](double h) { return one(body.output("energy.elastic", q + h * dq, z)); },
                      one(-body.force(q, z).dot(dq)));
  }
}

TEST_P(Meshes, StiffnessIsTheDerivativeOfTheForce) {
  for (const std::string& name : kKinematics) {
    const Body body(block(kTwoBranches, kinematics(name), GetParam()));
    Random random(413);
    const Vector q = random_dofs(random, body.s.size(), 0.03), dq = random_dofs(random, body.s.size(), 1),
                 z = body.random_internals(random);
    using Kind = InternalState::Kind;
    for (const InternalState& state :
         {InternalState{Kind::given, z.data(), 0}, InternalState{Kind::relaxed, nullptr, 0},
          InternalState{Kind::history, z.data(), 0.7}})
      expect_derivative([&](double h) { return body.force(q + h * dq, state); }, -body.stiffness(q, state) * dq);
  }
}

// The stiffness of an implicit step has the change of the internal variables with the positions.
TEST(Viscoelastic, StiffnessOfAnImplicitStepEliminatesTheInternalVariables) {
  for (const std::string& name : kKinematics) {
    const Body body(block(kTwoBranches, kinematics(name)));
    Random random(414);
    const Vector q = random_dofs(random, body.s.size(), 0.03), dq = random_dofs(random, body.s.size(), 1),
                 z = body.random_internals(random);
    const double gamma = 0.4;
    Vector de(z.size()), df(q.size());
    body.internal.strain_change(0, q, dq, de);
    const Vector dz = de.array() * gamma / (gamma + body.internal.relaxation_times().array());
    body.internal.force_change(0, q, dz, df);
    const Vector expected = body.stiffness(q, {InternalState::Kind::given, z.data(), 0}) * dq - df;
    const Vector eliminated = body.stiffness(q, {InternalState::Kind::given, z.data(), gamma}) * dq;
    EXPECT_LE((eliminated - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST_P(Meshes, StrainsAndForcesHaveTheirDerivatives) {
  for (const std::string& name : kKinematics) {
    const Body body(block(kTwoBranches, kinematics(name), GetParam()));
    Random random(415);
    const Vector q = random_dofs(random, body.s.size(), 0.03), dq = random_dofs(random, body.s.size(), 1),
                 z = body.random_internals(random), dz = body.random_internals(random);
    Vector de(z.size()), df(q.size());
    body.internal.strain_change(0, q, dq, de);
    expect_derivative([&](double h) { return body.strains(q + h * dq); }, de);
    body.internal.force_change(0, q, dz, df);
    EXPECT_LE((body.force(q, z + dz) - body.force(q, z) - df).norm(), 1e-13 * df.norm());
  }
}

TEST(Viscoelastic, PositiveSemidefiniteWithTheGaussNewtonPart) {
  const Body body(block("[{time: 0.1, share: 0.5}, {time: 3, share: 0.499}]"));
  Random random(416);
  const Vector q = random_dofs(random, body.s.size(), 0.2), z = body.random_internals(random);
  for (const double gamma : {0.0, 0.1, 1e6}) {
    const Eigen::MatrixXd K =
        body.stiffness(q, {InternalState::Kind::given, z.data(), gamma}, TangentKind::gauss_newton);
    EXPECT_GE(K.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12 * K.norm()) << gamma;
  }
}

// Power of the internal variables: the energy that they lose is dissipated.
TEST(Viscoelastic, DissipationIsTheLossOfEnergyAtAFixedShape) {
  for (const std::string& name : kKinematics) {
    const Body body(block(kTwoBranches, kinematics(name)));
    Random random(417);
    const Vector q = random_dofs(random, body.s.size(), 0.03), z = body.random_internals(random);
    const Vector rate = (body.strains(q) - z).cwiseQuotient(body.internal.relaxation_times());
    const double dissipated = body.output("power.dissipated", q, z);
    EXPECT_GT(dissipated, 0);
    expect_derivative([&](double h) { return one(body.output("energy.elastic", q, z + h * rate)); }, one(-dissipated));
    EXPECT_NEAR(body.output("power.dissipated", q, body.strains(q)), 0, 1e-15 * dissipated);
  }
}

// A rotated body has the same strains; its stresses turn with it, without a torque.
TEST(Viscoelastic, ForcesTurnWithTheBody) {
  const std::string yaml = R"(
mesh: {type: box, size: [1, 0.8, 0.6], cells: [2, 1, 1]}
materials: {m: {type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3, viscoelastic: )" +
                           kTwoBranches + "}}\nregions: {all: {material: m, axes: " + kTurnedAxes +
                           "}}\ntime: {end: 1}\n";
  const Body body(yaml);
  Random random(418);
  const Vector q = random_dofs(random, body.s.size(), 0.03), z = body.random_internals(random);
  const Mat3 R = Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const NodalVector x = body.s.positions(q), turned = R * x;
  Vector q_turned(q.size());
  body.s.model().parts().dofs->restrict_to(turned - *body.s.model().parts().rest, q_turned);
  EXPECT_LE((body.strains(q_turned) - body.strains(q)).norm(), 1e-14 * body.strains(q).norm() + 1e-15);
  const NodalVector f = body.s.nodal(body.force(q, z)), f_turned = body.s.nodal(body.force(q_turned, z));
  EXPECT_LE((f_turned - R * f).norm(), 1e-13 * f.norm());
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) torque += Vec3(x.col(i)).cross(Vec3(f.col(i)));
  EXPECT_LE(torque.norm(), 1e-13 * f.norm());
  EXPECT_LE(f.rowwise().sum().norm(), 1e-13 * f.norm());
}

// z' = (e - z) / tau with e(t) = e0 + t/h (e1 - e0) has the solution e(h) - (1 - x) ... of the closed form; many small
// intervals of a straight path give the same end as one.
TEST(History, OfOneIntervalIsThatOfManySmallOnes) {
  const Body body(block(kTwoBranches, kinematics("linear")));
  Random random(419);
  const Vector q0 = random_dofs(random, body.s.size(), 0.03), q1 = random_dofs(random, body.s.size(), 0.03),
               z0 = body.random_internals(random);
  const auto along = [&](int parts) {
    HistoryModel model(body.s.model());
    Vector z = z0;
    const double end = 0.5;
    for (int k = 0; k < parts; ++k) {
      const double s = k / static_cast<double>(parts), next = (k + 1) / static_cast<double>(parts);
      model.begin(s * end, q0 + s * (q1 - q0), z);
      z = model.values(next * end, q0 + next * (q1 - q0));
    }
    return z;
  };
  EXPECT_LE((along(7) - along(1)).norm(), 1e-14 * along(1).norm());
  // The differential equation by Heun's method with small steps.
  Vector z = z0;
  const int steps = 4000;
  const Vector e0 = body.strains(q0), e1 = body.strains(q1), tau = body.internal.relaxation_times();
  for (int k = 0; k < steps; ++k) {
    const double h = 0.5 / steps, s = k / static_cast<double>(steps);
    const Vector before = (e0 + s * (e1 - e0) - z).cwiseQuotient(tau);
    const Vector after = (e0 + (s + 1.0 / steps) * (e1 - e0) - z - h * before).cwiseQuotient(tau);
    z += h / 2 * (before + after);
  }
  EXPECT_LE((z - along(1)).norm(), 1e-6 * z.norm());
}

// Rubber whose shear modulus relaxes, in the mixed formulation.
std::string rubber(const std::string& branches, const std::string& kinematics, const std::string& mesh,
                   double young = 10, double nu = 0.49) {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.8, 0.6], cells: [2, 1, 1], {}}}
materials: {{m: {{type: isotropic, density: 1, young: {}, nu: {}{}}}}}
regions: {{all: {{material: m, formulation: mixed}}}}
elasticity: {{kinematics: {}}}
time: {{end: 2}}
)",
                     mesh, young, nu, branches.empty() ? "" : ", viscoelastic: " + branches, kinematics);
}
class MixedMeshes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Viscoelastic, MixedMeshes,
                         testing::Values("order: 2", "elements: hexahedra, order: 1", "elements: hexahedra, order: 2",
                                         "elements: wedges, order: 2"));

TEST_P(MixedMeshes, ForcesOfRubberHaveTheirDerivatives) {
  for (const std::string& name : kKinematics) {
    const Body body(rubber("[{time: 0.1, deviatoric: 0.5}, {time: 3, deviatoric: 0.3}]", name, GetParam()));
    Random random(420);
    const Vector q = random_dofs(random, body.s.size(), 0.02), dq = random_dofs(random, body.s.size(), 1),
                 z = body.random_internals(random);
    expect_derivative([&](double h) { return one(body.output("energy.elastic", q + h * dq, z)); },
                      one(-body.force(q, z).dot(dq)));
    using Kind = InternalState::Kind;
    for (const InternalState& state :
         {InternalState{Kind::given, z.data(), 0}, InternalState{Kind::relaxed, nullptr, 0}})
      expect_derivative([&](double h) { return body.force(q + h * dq, state); }, -body.stiffness(q, state) * dq);
  }
}

// Relaxed rubber is one with a lower shear modulus and the same bulk modulus, in any deformation: its pressure is split
// off by the relaxed stiffness.
TEST_P(MixedMeshes, RelaxedRubberKeepsItsBulkModulus) {
  const double young = 10, nu = 0.45, left = 0.05;
  const double shear = left * young / (2 * (1 + nu)), bulk = young / (3 * (1 - 2 * nu));
  for (const std::string& name : kKinematics) {
    const Body body(rubber("[{time: 0.1, deviatoric: 0.6}, {time: 3, deviatoric: 0.35}]", name, GetParam(), young, nu));
    const BuiltTestScene soft(rubber("", name, GetParam(), 9 * bulk * shear / (3 * bulk + shear),
                                     (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)));
    Random random(421);
    const Vector q = random_dofs(random, body.s.size(), 0.05), f = soft.force(q);
    EXPECT_GE(f.norm(), 1e-3);
    EXPECT_LE((body.s.force(q) - f).norm(), 1e-12 * f.norm());
  }
}

// A glassy polymer becomes nearly incompressible rubber.
TEST(Viscoelastic, TheRelaxedStiffnessDecidesTheFormulation) {
  const auto is_mixed = [](double share) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 2}}
materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0.4, viscoelastic: [{{time: 1, deviatoric: {}}}]}}}}
time: {{end: 1}}
)",
                                       share));
    return s.model().parts().elastic.front()->definition().mixed;
  };
  EXPECT_FALSE(is_mixed(0.1));
  EXPECT_TRUE(is_mixed(0.99));
}

TEST(Viscoelastic, InputIsRefusedWithTheReason) {
  const auto message = [](const std::string& branches, const std::string& more = "") {
    try {
      const BuiltTestScene s(block(branches, more));
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  using testing::HasSubstr;
  EXPECT_THAT(message("[{time: 1, share: 0.6}, {time: 2, share: 0.4}]"),
              HasSubstr("the relaxed stiffness is not positive definite"));
  EXPECT_THAT(message("[{time: 1, normal: [1, 0, 0]}]"), HasSubstr("must stay below 1"));
  EXPECT_THAT(message("[{time: 1}]"), HasSubstr("give one of"));
  EXPECT_THAT(message("[{time: 1, share: 0.1, normal: [0.1, 0, 0]}]"), HasSubstr("give one of"));
  EXPECT_THAT(message("[{time: 1, bulk: 0.1}]"), HasSubstr("isotropic"));
  EXPECT_THAT(message("[{time: 0, share: 0.1}]"), HasSubstr("time"));
  EXPECT_THAT(message("[{time: 1, share: 1.1}]"), HasSubstr("share"));
  EXPECT_THAT(message("[{time: 1, share: 0.1}]", "elasticity: {corotation: warped}"), HasSubstr("viscoelastic"));
  try {
    const BuiltTestScene s(rubber("[{time: 1, share: 0.1}]", "linear", "order: 2"));
    ADD_FAILURE() << "mixed formulation with a bulk modulus that relaxes";
  } catch (const ConfigError& e) {
    EXPECT_THAT(e.what(), HasSubstr("give `deviatoric` shares"));
  }
}

}  // namespace
}  // namespace orthodyn::viscoelastic_test
