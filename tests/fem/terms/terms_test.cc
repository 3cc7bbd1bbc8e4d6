// Springs, dashpots, point loads, pressure and ground contact: force against energy, K and D against the force by the
// observed order of differences, dissipation, and quantities that must vanish.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"
#include "tests/mesh/tets.h"

namespace orthodyn::terms_test {
namespace {

struct Case {
  std::string name, term;
};
void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
const auto name_of = [](const auto& tested) { return tested.param.name; };

const Case kSpring{"spring_between_nodes_of_no_element",
                   "{type: spring, between: [[1, 0, 0], [0, 1, 1]], stiffness: 3, rest_length: 0.7}"};
const Case kToAnchor{"springs_to_an_anchor",
                     "{type: spring, surface: x1, anchor: [2, 0.4, 0.3], stiffness: 3, rest_length: 1.5}"};
const Case kInPlace{"springs_in_place", "{type: spring, surface: x1, stiffness: 3}"};
const Case kNoLength{"spring_without_rest_length",
                     "{type: spring, between: [[1, 0, 0], [0, 1, 1]], stiffness: 3, rest_length: 0}"};
const Case kOnset{"ground_in_its_onset",
                  "{type: ground_contact, point: [0, 0, 0.3], normal: [0.1, 0.2, 1], stiffness: 5, onset: 1.5}"};
const Case kDeep{"ground_beyond_its_onset",
                 "{type: ground_contact, point: [0, 0, 0.5], stiffness: 5, onset: 0.01, surface: z0}"};
const Case kClosed{"pressure_on_a_closed_surface",
                   "{type: pressure, pressure: 0.4, factor: {type: constant, value: 1.5}}"};
const Case kBetween{"dashpot_between_nodes_of_no_element",
                    "{type: dashpot, between: [[1, 0, 0], [0, 1, 1]], coefficient: 3}"};
const Case kDragged{"dashpots_to_an_anchor", "{type: dashpot, surface: x1, anchor: [2, 0.4, 0.3], coefficient: 3}"};
const Case kDrag{"dashpots_in_place", "{type: dashpot, surface: x1, coefficient: 3}"};

BuiltTestScene block(const std::string& terms, const std::string& more = "") {
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [1, 1, 1], cells: [2, 2, 1], order: 1}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
terms: [{}]
time: {{end: 1}}
{})",
                                    fibre_material(10), kTurnedAxes, terms, more));
}
const std::string kClamps = "clamps: [{surface: x0, components: [x, y]}, {nearest: [1, 1, 1], components: [y]}]";

class StoringTerms : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Terms, StoringTerms, testing::Values(kSpring, kToAnchor, kInPlace, kNoLength, kOnset, kDeep),
                         name_of);
class StiffTerms : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Terms, StiffTerms,
                         testing::Values(kSpring, kToAnchor, kInPlace, kNoLength, kOnset, kDeep, kClosed), name_of);
class DampingTerms : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Terms, DampingTerms, testing::Values(kBetween, kDragged, kDrag), name_of);
class InnerTerms : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Terms, InnerTerms, testing::Values(kSpring, kNoLength, kClosed, kBetween), name_of);

TEST_P(StoringTerms, ForceIsMinusTheGradientOfTheEnergy) {
  Random random(301);
  const auto s = block(GetParam().term, kClamps);
  for (int sample = 0; sample < 3; ++sample) {
    const Vector q = random_dofs(random, s.size(), 0.05), d = random_dofs(random, s.size(), 1);
    expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
  }
}

TEST_P(StiffTerms, StiffnessIsMinusTheDerivativeOfTheForce) {
  Random random(302);
  const auto s = block(GetParam().term, kClamps), without = block("", kClamps);
  const Vector q = random_dofs(random, s.size(), 0.05);
  const Eigen::MatrixXd K = s.stiffness(q) - without.stiffness(q);
  EXPECT_GT(K.norm(), 0.1);
  for (int sample = 0; sample < 3; ++sample) {
    const Vector d = random_dofs(random, s.size(), 1);
    expect_derivative([&](double h) { return Vector(s.force(q + h * d) - without.force(q + h * d)); }, -K * d);
  }
}

TEST_P(StoringTerms, GaussNewtonTangentIsPositiveSemidefinite) {
  Random random(303);
  const auto s = block(GetParam().term, kClamps);
  for (const double amplitude : {0.05, 0.6}) {
    const Vector q = random_dofs(random, s.size(), amplitude);
    const Eigen::MatrixXd K = s.matrix({0, 0, 1}, q, s.zero(), TangentKind::gauss_newton);
    EXPECT_GE(symmetric_eigenvalues(K)[0], -1e-13 * K.norm()) << amplitude;
  }
}

TEST_P(StoringTerms, AreWithinTheFrequencyBound) {
  for (const char* mass : {"lumped", "consistent"}) {
    const auto s =
        block(GetParam().term, kClamps + fmt::format("\nmass: {}\nelasticity: {{kinematics: linear}}", mass));
    const Vector squares = symmetric_eigenvalues(s.stiffness(s.zero()), s.mass());
    EXPECT_LE(std::sqrt(squares.maxCoeff()), s.model().frequency_bound()) << mass;
  }
}

TEST_P(StoringTerms, ForceBetweenTwoStatesDoesTheWorkThatTheEnergyLoses) {
  Random random(312);
  const auto s = block(GetParam().term);
  for (const double shift : {0.0, 0.01, 0.3, 2.0}) {  // also from one zone of the contact to another
    const Vector q0 = random_dofs(random, s.size(), 0.05);
    const Vector q1 = random_dofs(random, s.size(), 0.05) + Vector::Constant(s.size(), shift);
    Vector f(s.size());
    s.model().discrete_gradient()->mean_force(0, q0, 0.1, q1, s.zero(), f);
    const double scale = s.potential(q0) + s.potential(q1) + (f.array() * (q1 - q0).array()).abs().sum();
    EXPECT_NEAR(f.dot(q1 - q0), s.potential(q0) - s.potential(q1), 1e-13 * scale) << shift;
  }
}

TEST_P(StoringTerms, ForceBetweenTwoStatesThatAreCloseIsThatInTheMiddle) {
  Random random(313);
  const auto s = block(GetParam().term, kClamps);
  const Vector q = random_dofs(random, s.size(), 0.2), d = random_dofs(random, s.size(), 1);
  for (const double h : {1e-4, 1e-7, 1e-10}) {
    Vector f(s.size());
    s.model().discrete_gradient()->mean_force(0, q, 0.1, q + h * d, s.zero(), f);
    EXPECT_LE((f - s.force(q + h / 2 * d)).norm(), (100 * h * h + 1e-13) * f.norm()) << h;
  }
}

TEST(FrequencyBound, CountsSpringsThatAreStifferThanTheBody) {
  const auto s = block("{type: spring, between: [[1, 0, 0], [0, 1, 1]], stiffness: 1e6, rest_length: 0}");
  const Vector squares = symmetric_eigenvalues(s.stiffness(s.zero()), s.mass());
  const double largest = std::sqrt(squares.maxCoeff()), bound = s.model().frequency_bound();
  EXPECT_LE(largest, bound);
  EXPECT_GE(largest, 0.5 * bound);
}

TEST_P(DampingTerms, DampingIsMinusTheDerivativeOfTheForceByVelocityWhichIsLinear) {
  Random random(304);
  const auto s = block(GetParam().term, kClamps);
  const Vector q = random_dofs(random, s.size(), 0.05), v = random_dofs(random, s.size(), 1);
  const Eigen::MatrixXd D = s.matrix({0, 1, 0}, q, v);
  const Vector drag = s.force(q, v) - s.force(q);
  EXPECT_GT(drag.norm(), 0.1);
  EXPECT_LE((drag + D * v).norm(), 1e-13 * (s.force(q).norm() + drag.norm()));
  EXPECT_TRUE(s.model().traits().damping_matrix);
}

TEST_P(DampingTerms, PowerIsThatOfItsForceAndNeverNegative) {
  Random random(305);
  const auto s = block(GetParam().term, kClamps);
  for (const double amplitude : {0.05, 0.6}) {
    const Vector q = random_dofs(random, s.size(), amplitude), v = random_dofs(random, s.size(), 1);
    const double power = s.scalar("power.dissipated", q, v);
    EXPECT_GE(power, 0);
    EXPECT_NEAR(power, -(s.force(q, v) - s.force(q)).dot(v), 1e-12 * (power + s.force(q).norm() * v.norm()));
  }
}

TEST_P(InnerTerms, ExertNoNetForceAndNoTorqueOnAFreeBody) {
  Random random(306);
  const auto s = block(GetParam().term), without = block("");
  const Vector q = random_dofs(random, s.size(), 0.2), v = random_dofs(random, s.size(), 1);
  const NodalVector f = s.nodal(s.force(q, v) - without.force(q, v)), x = s.positions(q);
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) moment += x.col(i).cross(f.col(i));
  EXPECT_GT(f.norm(), 0.05);
  EXPECT_LE(Vec3(f.rowwise().sum()).norm(), 1e-13 * s.force(q, v).norm());
  EXPECT_LE(moment.norm(), 1e-13 * s.force(q, v).norm());
}

TEST(Spring, PullsAlongItselfByStiffnessTimesStretch) {
  const auto s = block("{type: spring, nearest: [1, 1, 1], anchor: [4, 1, 1], stiffness: 2, rest_length: 1}");
  const auto without = block("");
  const NodalVector f = s.nodal(s.force(s.zero()) - without.force(s.zero()));
  EXPECT_LE((f.rowwise().sum() - Vec3(2 * (3 - 1), 0, 0)).norm(), 1e-14);
}

TEST(Spring, KeepsItsForceWhenTheBodyTurnsWithTheAnchorInTheMiddle) {
  const auto s = block("{type: spring, surface: x1, anchor: [0, 0, 0], stiffness: 2}");
  const Mat3 R = Random(307).rotation();
  EXPECT_LE(s.force(s.dofs([&](const Vec3& X) { return Vec3(R * X - X); })).norm(), 1e-13);
}

// V = sum of det F over the elements.
double volume(const BuiltTestScene& s, const Vector& q) {
  const NodalVector x = s.positions(q);
  double sum = 0;
  for (const Tet& t : tets_of(s.mesh())) {
    Mat3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = x.col(t[static_cast<std::size_t>(k) + 1]) - x.col(t[0]);
    sum += edges.determinant() / 6;
  }
  return sum;
}

TEST(Pressure, OnAClosedSurfaceIsMinusTheGradientOfPressureTimesVolume) {
  Random random(308);
  const auto s = block("{type: pressure, pressure: 0.4}"), without = block("");
  const Vector q = random_dofs(random, s.size(), 0.1), d = random_dofs(random, s.size(), 1);
  const double slope = (s.force(q) - without.force(q)).dot(d);
  expect_derivative([&](double h) { return one(-0.4 * volume(s, q + h * d)); }, one(slope));
}

TEST(Pressure, HasThePowerOfItsForce) {
  Random random(309);
  const auto without = block("");
  for (const char* keys : {"pressure: 0.4", "pressure: y + 2*z", "pressure: 0.4, follows: false"}) {
    const auto s = block(fmt::format("{{type: pressure, surface: x1, {}}}", keys));
    const Vector q = random_dofs(random, s.size(), 0.1), v = random_dofs(random, s.size(), 1);
    EXPECT_NEAR(s.scalar("power.loads", q, v), (s.force(q) - without.force(q)).dot(v), 1e-13 * v.norm()) << keys;
  }
}

TEST(Pressure, ThatIsDeadKeepsItsDirectionAndIsThatOfRest) {
  const auto dead = block("{type: pressure, surface: x1, pressure: 0.4, follows: false}");
  const auto following = block("{type: pressure, surface: x1, pressure: 0.4}"), without = block("");
  EXPECT_LE((dead.force(dead.zero()) - following.force(following.zero())).norm(), 8 * kEps);
  const Mat3 R = Random(314).rotation();
  const Vector q = dead.dofs([&](const Vec3& X) { return Vec3(1.7 * R * X - X); });
  EXPECT_LE((dead.force(q) - without.force(q) - dead.force(dead.zero())).norm(), 1e-12);
  EXPECT_EQ(dead.stiffness(q), without.stiffness(q));
}

TEST(Pressure, ByAFormulaIsThatOfThePlaceAtRest) {
  for (const char* follows : {"true", "false"}) {
    const auto s = block(fmt::format(
        "{{type: pressure, surface: x1, pressure: y^2*z, follows: {}, factor: {{type: constant, value: 3}}}}",
        follows));
    const NodalVector f = s.nodal(s.force(s.zero())), x = s.positions(s.zero());
    EXPECT_NEAR(f.row(0).sum(), -3 * (1. / 3) * (1. / 2), 1e-13);
    EXPECT_NEAR(f.row(0).dot(x.row(1)), -3 * (1. / 4) * (1. / 2), 1e-13);
    EXPECT_NEAR(f.row(0).dot(x.row(2)), -3 * (1. / 3) * (1. / 3), 1e-13);
    EXPECT_LE(f.bottomRows(2).norm(), 1e-14);
  }
}

// Hydrostatic pressure causes a buoyancy equal to the weight of the displaced water: divergence theorem.
TEST(Pressure, ThatGrowsWithDepthBuoysUp) {
  const auto s = block("{type: pressure, pressure: 4*(2 - z)}");
  EXPECT_LE((s.nodal(s.force(s.zero())).rowwise().sum() - Vec3(0, 0, 4)).norm(), 1e-13);
}

TEST(Pressure, ThatIsDeadOnAllFacesOfALinearCubeStrainsItEvenly) {
  const auto s = BuiltTestScene(R"(
mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 2], order: 1}
materials: {m: {type: isotropic, density: 1, young: 10, nu: 0.3}}
elasticity: {kinematics: linear}
clamps: [{surface: x0, components: [x]}, {surface: y0, components: [y]}, {surface: z0, components: [z]}]
terms: [{type: pressure, pressure: 2}]
time: {end: 1}
)");
  const double strain = -2 * (1 - 2 * 0.3) / 10;  // -p/(3 K), not small: of a linear body
  EXPECT_LE(s.force(s.dofs([&](const Vec3& X) { return Vec3(strain * X); })).norm(), 1e-13);
}

TEST(Pressure, FollowsTheSurface) {
  const auto s = block("{type: pressure, surface: x1, pressure: 0.4}");
  const Mat3 R = Random(310).rotation();
  const NodalVector f = s.nodal(s.force(s.dofs([&](const Vec3& X) { return Vec3(R * X - X); })));
  EXPECT_LE((f.rowwise().sum() - R * Vec3(-0.4, 0, 0)).norm(), 1e-13);
}

class PressureOnAnOpenSurface : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Pressures, PressureOnAnOpenSurface, testing::Values("0.4", "0.3 + 0.5*y*z"),
                         [](const auto& tested) { return tested.index == 0 ? "uniform" : "by_a_formula"; });

TEST_P(PressureOnAnOpenSurface, GivesTheSymmetricPartOfItsDerivative) {
  Random random(311);
  const std::string term = fmt::format("{{type: pressure, surface: x1, pressure: {}}}", GetParam());
  const std::string general = "elasticity: {corotation: warped, warped_tangent: unsymmetric}";
  const auto s = block(term), without = block("");
  const auto s_general = block(term, general), without_general = block("", general);
  const Vector q = random_dofs(random, s.size(), 0.1);
  const Eigen::MatrixXd K = s.stiffness(q) - without.stiffness(q);
  const Eigen::MatrixXd exact = s_general.stiffness(q) - without_general.stiffness(q);
  EXPECT_LE((K - 0.5 * (exact + exact.transpose())).norm(), 1e-13 * s.stiffness(q).norm());
  EXPECT_GE((K - exact).norm(), 0.1 * exact.norm());
  const Vector d = random_dofs(random, s.size(), 1);
  expect_derivative([&](double h) { return Vector(s.force(q + h * d) - without.force(q + h * d)); }, -exact * d);
}

TEST(Ground, PushesByStiffnessTimesAreaTimesDepthLessHalfTheOnset) {
  const auto at = [](double depth, double onset) {
    const auto s = block(
        fmt::format("{{type: ground_contact, point: [0, 0, {}], stiffness: 5, onset: {}, surface: z0}}", depth, onset));
    return Vec3(s.nodal(s.force(s.zero())).rowwise().sum());
  };
  EXPECT_LE((at(0.3, 0.1) - Vec3(0, 0, 5 * (0.3 - 0.05))).norm(), 1e-13);
  EXPECT_LE((at(0.05, 0.1) - Vec3(0, 0, 5 * 0.05 * 0.05 / 0.2)).norm(), 1e-13);
  EXPECT_LE(at(-0.01, 0.1).norm(), 1e-14);
}

TEST(Ground, HasAContinuousTangentWhereContactSetsInAndWhereTheOnsetEnds) {
  const auto stiffness = [](double depth) {
    const auto s = block(
        fmt::format("{{type: ground_contact, point: [0, 0, {:.17g}], stiffness: 5, onset: 0.1, surface: z0}}", depth));
    return s.stiffness(s.zero());
  };
  for (const double depth : {0.0, 0.1})
    EXPECT_LE((stiffness(depth + 1e-9) - stiffness(depth - 1e-9)).norm(), 5e-7) << depth;
}

TEST(PointLoad, IsSharedBySelectedNodesAndFollowsItsFactor) {
  const auto s = block("{type: point_load, surface: x1, force: [1, 2, -3], factor: {type: ramp, end: 2, value: 4}}");
  const NodalVector f = s.nodal(s.force(s.zero(), s.zero(), 1));
  EXPECT_LE((f.rowwise().sum() - 2 * Vec3(1, 2, -3)).norm(), 1e-14);
  for (Eigen::Index i = 0; i < f.cols(); ++i)
    if (s.model().parts().rest->col(i)[0] == 1) {
      EXPECT_LE((f.col(i) - Vec3(1, 2, -3) / 3).norm(), 1e-14);
    }
  EXPECT_TRUE(s.model().traits().time_dependent);
  EXPECT_EQ(s.model().breakpoints(-1, 1), (std::vector<double>{0}));
}

TEST(Terms, WithALinearForceLeaveALinearModelLinear) {
  const std::string linear = "elasticity: {kinematics: linear}";
  EXPECT_TRUE(block(kInPlace.term, linear).model().traits().linear);
  EXPECT_TRUE(block(kDrag.term, linear).model().traits().linear);
  EXPECT_TRUE(block(kClosed.term, linear).model().traits().linear);
  EXPECT_FALSE(block("{type: pressure, pressure: 0.4, follows: true}", linear).model().traits().linear);
  for (const Case& c : {kSpring, kToAnchor, kOnset, kBetween})
    EXPECT_FALSE(block(c.term, linear).model().traits().linear) << c.name;
}

TEST(Terms, ThatAreAbsentLeaveThePatternAlone) {
  const auto none = block(""), in_place = block(kInPlace.term), between = block(kSpring.term);
  EXPECT_EQ(in_place.model().pattern().non_zeros(), none.model().pattern().non_zeros());
  EXPECT_EQ(between.model().pattern().non_zeros(), none.model().pattern().non_zeros() + 9);
}

}  // namespace
}  // namespace orthodyn::terms_test
