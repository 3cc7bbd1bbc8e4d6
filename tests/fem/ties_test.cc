// Ties of surfaces whose meshes do not match: weights, patch test, forces, mass, rigid motions, and input that is
// refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "lib/core/parallel.h"
#include "lib/fem/surface.h"
#include "lib/fem/ties/mortar.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::ties_test {
namespace {

// A block on another one, glued at z = 1. Shapes of the meshes: `lower` and `upper` are keys of the boxes.
std::string blocks(const std::string& lower, const std::string& upper, const std::string& more = "",
                   const std::string& ties = "{first: upper.z0, second: lower.z1}") {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 1.2, 1], {}}}}}
    upper: {{mesh: {{type: box, size: [1, 1.2, 0.8], {}}}, translation: [0, 0, 1]}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3}}}}
regions: {{all: {{material: m, axes: {}}}}}
ties: [{}]
time: {{end: 1}}
{}
)",
                     lower, upper, kTurnedAxes, ties, more);
}

struct Meshes {
  const char *name, *lower, *upper;
};
const std::vector<Meshes> kMeshes{
    {"tet4", "cells: [2, 3, 2], order: 1", "cells: [3, 2, 2], order: 1"},
    {"tet10", "cells: [2, 3, 1]", "cells: [3, 2, 1]"},
    {"hex8", "cells: [2, 3, 2], elements: hexahedra, order: 1", "cells: [3, 2, 2], elements: hexahedra, order: 1"},
    {"hex20", "cells: [2, 3, 1], elements: hexahedra", "cells: [3, 2, 1], elements: hexahedra"},
    {"hex27", "cells: [2, 3, 1], elements: hexahedra_27", "cells: [3, 2, 1], elements: hexahedra_27"},
    {"hex20_on_tet10", "cells: [2, 3, 1]", "cells: [3, 4, 1], elements: hexahedra"},
};

class TiesOf : public testing::TestWithParam<Meshes> {
 protected:
  std::string scene(const std::string& more = "") const { return blocks(GetParam().lower, GetParam().upper, more); }
};

// Constant tractions on both surfaces have the same resultants at the nodes of the second surface, node by node.
TEST_P(TiesOf, WeightsGiveLinearFieldsAndPassConstantTractions) {
  const BuiltTestScene s(scene());
  const Mesh& mesh = s.mesh();
  const Ties& ties = s.model().parts().dofs->ties();
  const Mat3 F = Random(61).matrix();
  ASSERT_GE(ties.nodes().size(), 12u);
  std::map<int, Vec3> passed;
  std::map<int, Vec3> on_first;
  for (const auto& [node, force] : surface_forces(mesh, mesh.surfaces.at("upper.z0"), Vec3(1, 2, -3)))
    on_first[node] = force;
  for (const TiedNode& tied : ties.nodes()) {
    Vec3 sum = Vec3::Zero();
    double one = 0;
    for (const auto& [leader, weight] : tied.leaders) {
      sum += weight * (F * mesh.node(leader));
      one += weight;
      passed.try_emplace(leader, Vec3::Zero()).first->second += weight * on_first.at(tied.node);
    }
    EXPECT_NEAR(one, 1, 1e-13);
    EXPECT_LE((sum - F * mesh.node(tied.node)).norm(), 1e-13);
  }
  for (const auto& [node, force] : surface_forces(mesh, mesh.surfaces.at("lower.z1"), Vec3(1, 2, -3)))
    EXPECT_LE((passed.at(node) - force).norm(), 1e-13) << node;
}

// A field of constant strain is in equilibrium with the tractions of its stress on the outer surfaces.
TEST_P(TiesOf, PassThePatchTest) {
  const BuiltTestScene s(scene("elasticity: {kinematics: linear}"));
  const Mat3 F = 0.01 * Random(62).matrix();
  const Vector q = s.dofs([&](const Vec3& X) { return Vec3(F * X); });
  const auto stress = s.model().evaluate("stress", {0, q, s.zero()});
  const auto c = [&](std::size_t k) { return stress[k]; };
  for (std::size_t k = 6; k < stress.size(); ++k) EXPECT_NEAR(stress[k], stress[k % 6], 1e-13) << k;
  const Mat3 sigma = (Mat3() << c(0), c(3), c(5), c(3), c(1), c(4), c(5), c(4), c(2)).finished();
  NodalVector loads = NodalVector::Zero(3, s.positions(q).cols());
  for (const auto& [name, faces] : s.mesh().surfaces) {
    if (name == "upper.z0" || name == "lower.z1") continue;
    const Vec3 normal = (name.back() == '1' ? 1 : -1) * Vec3::Unit(name[name.size() - 2] - 'x');
    for (const auto& [node, force] : surface_forces(s.mesh(), faces, sigma * normal)) loads.col(node) += force;
  }
  Vector f(s.size());
  s.model().parts().dofs->restrict_forces_to(loads, f);
  EXPECT_GE(f.norm(), 1e-3);
  EXPECT_LE((f + s.force(q)).norm(), 1e-12 * f.norm());
}

TEST_P(TiesOf, ForceAndTangentAreDerivatives) {
  const BuiltTestScene s(scene("damping: {stiffness: 0.1}"));
  Random random(63);
  const Vector q = random_dofs(random, s.size(), 0.02), d = random_dofs(random, s.size(), 1);
  expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
  expect_derivative([&](double h) { return s.force(q + h * d); }, -s.stiffness(q) * d);
  expect_derivative([&](double h) { return s.force(q, h * d); }, -s.matrix({0, 1, 0}, q, s.zero()) * d);
}

// The consistent mass is T^T M T: its kinetic energy equals the kinetic energy of the separate bodies, whose nodes have
// the velocities T v.
TEST_P(TiesOf, MassHasTheKineticEnergyOfBothBodies) {
  const BuiltTestScene tied(scene("mass: consistent"));
  const BuiltTestScene apart(blocks(GetParam().lower, GetParam().upper, "mass: consistent", ""));
  Random random(64);
  const Vector v = random_dofs(random, tied.size(), 1);
  Vector all(apart.size());
  apart.model().parts().dofs->restrict_to(tied.nodal(v), all);
  EXPECT_NEAR(tied.scalar("energy.kinetic", tied.zero(), v), apart.scalar("energy.kinetic", apart.zero(), all), 1e-12);
}

TEST_P(TiesOf, TurnRigidlyWithoutForces) {
  const BuiltTestScene s(scene());
  const Mat3 R = Random(65).rotation();
  const Vector q = s.dofs([&](const Vec3& X) { return Vec3(R * X + Vec3(1, 2, 3) - X); });
  EXPECT_LE(s.force(q).norm(), 1e-12);
  Random random(66);
  const Vector bent = random_dofs(random, s.size(), 0.05);
  NodalVector f = NodalVector::Zero(3, s.positions(bent).cols());
  s.model().parts().dofs->add_forces_to(s.force(bent), f);
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) torque += Vec3(s.positions(bent).col(i)).cross(Vec3(f.col(i)));
  EXPECT_LE(f.rowwise().sum().norm(), 1e-12 * f.norm());
  EXPECT_LE(torque.norm(), 1e-12 * f.norm());
}

INSTANTIATE_TEST_SUITE_P(Elements, TiesOf, testing::ValuesIn(kMeshes),
                         [](const testing::TestParamInfo<Meshes>& tested) { return std::string(tested.param.name); });

TEST(Ties, OfMatchingMeshesJoinNodeToNode) {
  for (const std::string mesh :
       {"cells: [2, 3, 2], elements: hexahedra", "cells: [2, 3, 2], elements: hexahedra, order: 1"}) {
    const BuiltTestScene s(blocks(mesh, mesh));
    for (const TiedNode& tied : s.model().parts().dofs->ties().nodes()) {
      ASSERT_EQ(tied.leaders.size(), 1u);
      EXPECT_NEAR(tied.leaders[0].second, 1, 1e-13);
    }
  }
}

TEST(Ties, GeneralAndSymmetricStorageAgree) {
  const std::string yaml = blocks(kMeshes[1].lower, kMeshes[1].upper);
  const BuiltTestScene s(yaml);
  const BuiltScene general = s.scene.places.with([&] { return build(s.scene, nullptr, MatrixStorage::general); });
  Random random(67);
  const Vector q = random_dofs(random, s.size(), 0.02), x = random_dofs(random, s.size(), 1);
  Linearization at;
  general.model->linearize(0, q, s.zero(), TangentKind::exact, at);
  Vector y(s.size());
  general.model->multiply_matrix(at.stiffness.data(), x, y);
  EXPECT_LE((y - s.stiffness(q) * x).norm(), 1e-12 * y.norm());
}

// Mass, momentum and the bound of the frequencies with lumped masses.
TEST(Ties, LumpedMassesMoveToTheLeaders) {
  const BuiltTestScene s(blocks(kMeshes[0].lower, kMeshes[0].upper));
  const Eigen::MatrixXd M = s.mass();
  EXPECT_NEAR(M.trace(), 3 * 1.2 * 1.8, 1e-12);
  EXPECT_GT(M.diagonal().minCoeff(), 0);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(s.stiffness(s.zero()), M);
  const double highest = std::sqrt(modes.eigenvalues().maxCoeff());
  EXPECT_GE(s.model().frequency_bound(), highest);
  EXPECT_LE(s.model().frequency_bound(), 3 * highest);
}

TEST(Ties, ReplaceLeadersThatAreTied) {
  const Ties ties(4, {{0, {{1, 0.5}, {2, 0.5}}}, {1, {{3, 2}, {2, -1}}}});
  std::map<int, double> leaders;
  ties.for_each_leader(0, [&](int node, double weight) { leaders[node] = weight; });
  EXPECT_EQ(leaders, (std::map<int, double>{{2, 0}, {3, 1}}));
  EXPECT_THROW(Ties(3, {{0, {{1, 1}}}, {1, {{2, 0.5}, {0, 0.5}}}}), ConfigError);
}

// Three blocks in a row, of which the middle one follows the first, and the last one the middle one.
TEST(Ties, MayFollowEachOther) {
  const std::string box = "{type: box, size: [1, 1, 1], order: 1, cells: ";
  const auto scene = [&](const std::string& ties) {
    return fmt::format(
        "mesh: {{type: bodies, bodies: {{a: {{mesh: {0}[2, 2, 1]}}}}, b: {{mesh: {0}[3, 3, 1]}}, "
        "translation: [0, 0, 1]}}, c: {{mesh: {0}[2, 1, 1]}}, translation: [0, 0, 2]}}}}}}\n"
        "materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0.3}}}}\ntime: {{end: 1}}\n"
        "ties: [{1}]\n",
        box, ties);
  };
  const BuiltTestScene s(scene("{first: c.z0, second: b.z1}, {first: b.z0, second: a.z1}"));
  const Mat3 R = Random(68).rotation();
  EXPECT_LE(s.force(s.dofs([&](const Vec3& X) { return Vec3(R * X - X); })).norm(), 1e-12);
}

// Block b hangs on the side of block a, which stands on block c. At the common edge, b follows nodes of a that follow
// c. Each tie carries the weight of the blocks beyond it, with either mass; in free fall it carries nothing.
TEST(Ties, ForcesAreThoseThatTheyCarry) {
  for (const char* mass : {"lumped", "consistent"}) {
    const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    a: {{mesh: {{type: box, size: [1, 1, 1], cells: [2, 2, 1], elements: hexahedra}}}}
    b: {{mesh: {{type: box, size: [1, 1, 1], cells: [1, 3, 2]}}, translation: [1, 0, 0]}}
    c: {{mesh: {{type: box, size: [1, 1, 1], cells: [2, 3, 1], elements: hexahedra}}, translation: [0, 0, -1]}}
materials: {{m: {{type: isotropic, density: 2, young: 1e4, nu: 0.3}}}}
ties: [{{name: side, first: b.x0, second: a.x1}}, {{name: foot, first: a.z0, second: c.z1}}]
gravity: [0, 0, -10]
clamps: [{{surface: c.z0}}]
elasticity: {{kinematics: linear}}
mass: {}
time: {{end: 1}}
)",
                                       mass));
    const Vector q = linear_static(s);
    EXPECT_NEAR(s.model().evaluate("tie.foot", {0, q, s.zero()})[2], 40, mass == std::string("lumped") ? 2 : 1e-6)
        << mass;  // lumped masses of b at the edge go to c, past the foot
    EXPECT_NEAR(s.model().evaluate("tie.side", {0, q, s.zero()})[2], 20, 1e-6) << mass;
  }
  const BuiltTestScene chain(
      "mesh: {type: bodies, bodies: {a: {mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 1]}}, b: {mesh: {type: box, "
      "size: [1, 1, 1], cells: [3, 2, 1]}, translation: [0, 0, 1]}}}\n"
      "materials: {m: {type: isotropic, density: 2, young: 1e4, nu: 0.3}}\n"
      "ties: [{first: a.z1, second: b.z0}]\ngravity: [0, 0, -10]\ntime: {end: 1}\n");
  EXPECT_LE(std::abs(chain.model().evaluate("tie.tie_1", {0, chain.zero(), chain.zero()})[2]), 1e-10);  // free fall
}

TEST(Ties, AreTheSameWithAnyNumberOfThreads) {
  const std::string yaml = blocks("cells: [12, 12, 6], order: 1", "cells: [11, 11, 6], order: 1");
  const BuiltTestScene s(yaml);
  Random random(69);
  const Vector q = random_dofs(random, s.size(), 0.01);
  const auto values = [&] {
    Linearization at;
    s.model().linearize(0, q, s.zero(), TangentKind::exact, at);
    return at.stiffness;
  };
  const std::vector<double> one_thread = [&] {
    const LoopThreads threads(1);
    return values();
  }();
  const LoopThreads threads(4);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(values(), one_thread);
}

// A cylinder in a tube: both surfaces are polygons of different sides. Rigid motions are exact, because the tied nodes
// lie on the faces of the second surface.
TEST(Ties, OfCurvedSurfacesKeepRigidMotions) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    rod: {mesh: {type: cylinder, radius: 1, length: 1, cells: [20, 2, 2]}}
    tube: {mesh: {type: tube, radius: 1.5, inner_radius: 1, length: 1, cells: [24, 1, 3]}}
materials: {m: {type: isotropic, density: 1, young: 1, nu: 0.3}}
ties: [{first: rod.outer, second: tube.inner}]
time: {end: 1}
)");
  const Mat3 R = Random(70).rotation();
  EXPECT_LE(s.force(s.dofs([&](const Vec3& X) { return Vec3(R * X - X); })).norm(), 1e-12);
}

TEST(Ties, ClampsOfTiedNodesActOnTheirLeaders) {
  const BuiltTestScene s(
      blocks(kMeshes[1].lower, kMeshes[1].upper, "clamps: [{plane: {point: [0, 0, 0], normal: [1, 0, 0]}}]"));
  const Ties& ties = s.model().parts().dofs->ties();
  int at_clamp = 0;
  for (const TiedNode& tied : ties.nodes()) at_clamp += std::abs(s.mesh().node(tied.node)[0]) < 1e-12;
  EXPECT_GE(at_clamp, 3);
  EXPECT_NO_THROW(linear_static(s));
}

TEST(Ties, AreRefusedWithTheReason) {
  const auto message = [](const std::string& ties, const std::string& more = "", double shift = 0) {
    try {
      std::string yaml = blocks("cells: [2, 2, 1]", "cells: [2, 3, 1]", more, ties);
      if (shift != 0) {
        const std::string place = "translation: [0, 0, 1]";
        yaml.replace(yaml.find(place), place.size(), fmt::format("translation: [{0}, 0, {1}]", shift, 1 + shift));
      }
      const BuiltTestScene s(yaml);
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  using testing::HasSubstr;
  const std::string tie = "{first: upper.z0, second: lower.z1}";
  EXPECT_EQ(message(tie), "accepted");
  EXPECT_THAT(message("{first: upper.z0, second: lower.z9}"), HasSubstr("lower.z1"));
  EXPECT_THAT(message("{first: upper.z0, second: upper.z0}"), HasSubstr("the same surface"));
  EXPECT_THAT(message("{first: upper.z0, second: upper.x0}"), HasSubstr("share"));
  EXPECT_THAT(message("{first: upper.z1, second: lower.z1}"), HasSubstr("100 % of the surface"));
  EXPECT_THAT(message(tie, "", 0.2), HasSubstr("no counterpart"));
  EXPECT_EQ(message("{first: upper.z0, second: lower.z1, reach: 0.01}", "", 0.005), "accepted");
  EXPECT_THAT(message(tie + ", " + tie), HasSubstr("tied already"));
  EXPECT_THAT(message(tie + ", {first: lower.z1, second: upper.z0}"), HasSubstr("in a circle"));
  EXPECT_THAT(message(tie, "clamps: [{surface: upper.z0}]"), HasSubstr("is clamped or moved"));
  EXPECT_THAT(message(tie, "motions: [{surface: upper.z0, displacement: [t, 0, 0]}]\nclamps: [{surface: lower.z1}]"),
              HasSubstr("is clamped or moved"));
}

}  // namespace
}  // namespace orthodyn::ties_test
