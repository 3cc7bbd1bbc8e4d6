// Contact of bodies: the nearest point and its derivatives, forces, tangents, resultants, pressure, and input that is
// refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/fem/contact/contact_surface.h"
#include "lib/fem/contact/penalty.h"
#include "lib/fem/surface.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::contact_test {
namespace {

struct Place {
  const char* name;
  Vec3 x;
  int corners;  // of the triangle, edge or corner that is nearest
};
const Triangle kTriangle = (Triangle() << 0, 1, 0.2, 0, 0.1, 0.9, 0, 0.05, -0.1).finished();

class NearestPoint : public testing::TestWithParam<Place> {};
INSTANTIATE_TEST_SUITE_P(Places, NearestPoint,
                         testing::Values(Place{"inside", {0.4, 0.3, -0.3}, 3}, Place{"edge", {0.5, -0.4, -0.3}, 2},
                                         Place{"edge_2", {0.9, 0.9, 0.2}, 2}, Place{"corner", {-0.5, -0.4, -0.3}, 1},
                                         Place{"corner_2", {1.5, -0.1, 0.3}, 1}),
                         [](const testing::TestParamInfo<Place>& tested) { return std::string(tested.param.name); });

Distance distance(const Vec12& z) {
  Triangle t;
  t << z.segment<3>(3), z.segment<3>(6), z.segment<3>(9);
  const Vec3 x = z.head<3>();
  return distance_of(x, t, nearest_point(x, t));
}

Vec12 all_coordinates(const Vec3& x) {
  Vec12 z;
  z << x, kTriangle.col(0), kTriangle.col(1), kTriangle.col(2);
  return z;
}

TEST_P(NearestPoint, IsNearerThanAllOthers) {
  const Vec3 L = nearest_point(GetParam().x, kTriangle);
  EXPECT_EQ((L.array() > 0).count(), GetParam().corners);
  EXPECT_NEAR(L.sum(), 1, 1e-15);
  const double r = (GetParam().x - kTriangle * L).norm();
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; i + j <= 40; ++j) {
      const Vec3 other(i / 40.0, j / 40.0, (40 - i - j) / 40.0);
      EXPECT_GE((GetParam().x - kTriangle * other).norm(), r - 1e-15);
    }
}

TEST_P(NearestPoint, HasItsDerivatives) {
  const Vec12 z = all_coordinates(GetParam().x);
  Random random(71);
  const Vec12 direction = random_dofs(random, 12, 1);
  const Distance at = distance(z);
  expect_derivative([&](double h) { return one(distance(z + h * direction).r); }, one(at.gradient().dot(direction)));
  expect_derivative([&](double h) { return Vector(distance(z + h * direction).gradient()); },
                    at.second_derivative() * direction / at.r);
}

// A block that lies `overlap` m deep in another one, moved sideways.
std::string blocks(const std::string& lower, const std::string& upper, double overlap, const std::string& more = "") {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 1, 0.5], {}}}}}
    upper: {{mesh: {{type: box, size: [0.6, 0.6, 0.5], {}}}, translation: [0.17, 0.13, {}]}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3}}}}
terms: [{{type: contact, between: [lower.z1, upper.z0], stiffness: 20, onset: 0.01}}]
time: {{end: 1}}
{}
)",
                     lower, upper, 0.5 - overlap, more);
}

struct Meshes {
  const char *name, *lower, *upper;
};
class ContactOf : public testing::TestWithParam<Meshes> {};
INSTANTIATE_TEST_SUITE_P(Elements, ContactOf,
                         testing::Values(Meshes{"tet4", "cells: [4, 3, 1], order: 1", "cells: [3, 2, 1], order: 1"},
                                         Meshes{"tet10", "cells: [2, 3, 1]", "cells: [3, 2, 1]"},
                                         Meshes{"hex8", "cells: [4, 3, 1], elements: hexahedra, order: 1",
                                                "cells: [3, 2, 1], elements: hexahedra, order: 1"},
                                         Meshes{"hex20", "cells: [2, 3, 1], elements: hexahedra",
                                                "cells: [3, 2, 1], elements: hexahedra"},
                                         Meshes{"hex27", "cells: [2, 3, 1], elements: hexahedra_27",
                                                "cells: [3, 2, 1], elements: hexahedra_27"}),
                         [](const testing::TestParamInfo<Meshes>& tested) { return std::string(tested.param.name); });

TEST_P(ContactOf, ForceAndTangentAreDerivatives) {
  const BuiltTestScene s(blocks(GetParam().lower, GetParam().upper, 0.03));
  Random random(72);
  const Vector q = random_dofs(random, s.size(), 2e-3), d = random_dofs(random, s.size(), 0.02);
  const BuiltTestScene apart(blocks(GetParam().lower, GetParam().upper, -0.1));
  EXPECT_GE((s.force(q) - apart.force(q)).norm(), 1e-2) << "no contact";
  expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
  expect_derivative([&](double h) { return s.force(q + h * d); }, -s.stiffness(q) * d);
}

// Friction acts against the relative velocities of the bodies: the derivatives by velocity, the dissipated power, and
// no resultant.
TEST_P(ContactOf, FrictionHasItsDerivativesAndDissipates) {
  std::string yaml = blocks(GetParam().lower, GetParam().upper, 0.03);
  yaml.replace(yaml.find("onset: 0.01"), 11, "onset: 0.01, friction: 0.4, creep: 0.5");
  const BuiltTestScene s(yaml), smooth(blocks(GetParam().lower, GetParam().upper, 0.03));
  Random random(74);
  const Vector q = random_dofs(random, s.size(), 2e-3), v = random_dofs(random, s.size(), 1),
               d = random_dofs(random, s.size(), 0.1);
  const Vector drag = s.force(q, v) - smooth.force(q, v);
  EXPECT_GE(drag.norm(), 1e-2);
  EXPECT_LE(std::abs(drag.sum()), 1e-12 * drag.norm());
  EXPECT_NEAR(s.scalar("power.dissipated", q, v), -drag.dot(v), 1e-12 * drag.norm() * v.norm());
  EXPECT_GT(s.scalar("power.dissipated", q, v), 0);
  expect_derivative([&](double h) { return s.force(q, v + h * d); }, -s.matrix({0, 1, 0}, q, v) * d);
}

TEST_P(ContactOf, ForcesHaveNoResultantAndNoTorque) {
  const BuiltTestScene s(blocks(GetParam().lower, GetParam().upper, 0.03));
  Random random(73);
  const Vector q = random_dofs(random, s.size(), 5e-3);
  NodalVector f = NodalVector::Zero(3, s.positions(q).cols());
  s.model().parts().dofs->add_forces_to(s.force(q), f);
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) torque += Vec3(s.positions(q).col(i)).cross(Vec3(f.col(i)));
  EXPECT_LE(f.rowwise().sum().norm(), 1e-13 * f.norm());
  EXPECT_LE(torque.norm(), 1e-13 * f.norm());
}

// The lower face of a block is 0.1 m below the ground. Its nodal forces are the consistent forces of a uniform
// pressure; those at the corners of quadrilaterals with eight nodes pull.
TEST_P(ContactOf, ForcesOfAUniformDepthAreThoseOfAPressure) {
  const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 1, 0.5], {}}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3}}}}
terms: [{{type: ground_contact, name: floor, surface: z0, point: [0, 0, 0.1], stiffness: 20, onset: 0.02}}]
time: {{end: 1}}
)",
                                     GetParam().lower));
  NodalVector f = NodalVector::Zero(3, s.positions(s.zero()).cols()), expected = f;
  s.model().parts().dofs->add_forces_to(s.force(s.zero()), f);
  const Vec3 pressure(0, 0, 20 * (0.1 - 0.01));
  for (const auto& [node, force] : surface_forces(s.mesh(), s.mesh().surfaces.at("z0"), pressure))
    expected.col(node) += force;
  EXPECT_LE((f - expected).norm(), 1e-13 * expected.norm());
  const State rest{0, s.zero(), s.zero()};
  EXPECT_NEAR(s.model().evaluate("contact.floor", rest).at(2), pressure[2], 1e-12);  // of an area of 1 m^2
  EXPECT_NEAR(s.model().evaluate("contact_pressure.floor", rest).at(0), pressure[2], 1e-12);
}

// At rest, all nodes of the upper surface are 0.03 m deep, and so are the nodes of the lower surface below the upper
// block. Each node bears k psi'(0.03)/2 = 10 (0.03 - 0.005) Pa on its area.
TEST_P(ContactOf, PressureIsThatOfTheDepth) {
  const BuiltTestScene s(blocks(GetParam().lower, GetParam().upper, 0.03));
  NodalVector f = NodalVector::Zero(3, s.positions(s.zero()).cols());
  s.model().parts().dofs->add_forces_to(s.force(s.zero()), f);
  const ContactSurface upper(s.mesh(), s.mesh().surfaces.at("upper.z0"));
  const ContactSurface lower(s.mesh(), s.mesh().surfaces.at("lower.z1"));
  double own = 0, area = 0;
  for (const auto& [point, of_point] : upper.areas()) {
    if (point < f.cols()) own += f(2, point);
    area += of_point;
  }
  EXPECT_NEAR(area, 0.36, 1e-12);
  for (const auto& [point, of_point] : lower.areas()) {
    Vec3 x = Vec3::Zero();
    lower.middles().for_each_node(point, [&](int node, double weight) { x += weight * s.mesh().node(node); });
    if (x[0] > 0.165 && x[0] < 0.77 && x[1] > 0.13 && x[1] < 0.73) area += of_point;
  }
  EXPECT_NEAR(own, area * 10 * 0.025, 1e-12);
  const State rest{0, s.zero(), s.zero()};  // the first surface is the lower one
  const std::vector<double> force = s.model().evaluate("contact.contact_1", rest);
  EXPECT_NEAR(force.at(2), -own, 1e-12);
  EXPECT_NEAR(std::hypot(force.at(0), force.at(1)), 0, 1e-13);
  EXPECT_NEAR(s.model().evaluate("contact_pressure.contact_1", rest).at(0), 20 * 0.025, 1e-12);
}

TEST(Contact, ActsBelowTheSurfaceUpToTheReachOnly) {
  const std::string lower = "cells: [2, 2, 1], order: 1", upper = "cells: [1, 1, 1], order: 1";
  const auto energy = [&](double overlap) {
    const BuiltTestScene s(blocks(lower, upper, overlap));
    return s.potential(s.zero());
  };
  EXPECT_EQ(energy(-0.01), 0);
  EXPECT_EQ(energy(0), 0);
  EXPECT_GT(energy(0.005), 0);
  EXPECT_GT(energy(0.1), energy(0.05));
  EXPECT_EQ(energy(0.45), 0);  // half of the mean edge is less
}

// Nodes near the ridges and the top of a roof: there, the mean normal of the triangles decides which side is inside.
TEST(Contact, KnowsTheInsideAtEdgesAndCorners) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.5}};  // a roof, and its walls below
  const std::vector<FaceCorners> roof{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  Mesh solid = mesh;
  solid.nodes.push_back({0.5, 0.5, -0.5});
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 3), std::pair(3, 0)})
    solid.cells.add(CellShape::tet4, std::vector<int>{a, b, 4, 5});
  const ContactSurface surface(solid, roof);
  NodalVector x(3, 7);
  for (Eigen::Index i = 0; i < 6; ++i) x.col(i) = solid.nodes[static_cast<std::size_t>(i)];
  const auto depth = [&](const Vec3& place) {
    x.col(6) = place;
    const auto touch = PlacedSurface(surface, x, 0.3).touch_of(6);
    return touch ? touch->distance.r : -1;
  };
  EXPECT_NEAR(depth({0.5, 0.4, 0.3}), 0.1 / std::sqrt(2.0), 1e-12);  // below the roof's side y < x
  EXPECT_EQ(depth({0.5, 0.5, 0.6}), -1);                             // above the top
  EXPECT_EQ(depth({0.5, 0.2, 0.3}), -1);                             // above a side
  EXPECT_EQ(depth({0.5, -0.1, -0.1}), -1);                           // beside the boundary
  EXPECT_GT(depth({0.5, 0.5, 0.4}), 0);                              // below the top
}

// Blocks beside each other whose tops are flush but for round-off: the nodes of one are beside an edge of the other.
TEST(Contact, IgnoresNodesBesideAnEdge) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    a: {mesh: {type: box, size: [0.1, 0.1, 0.05], cells: [2, 2, 1], elements: hexahedra, order: 1, origin: [-0.05, -0.05, -0.025]}}
    b: {mesh: {type: box, size: [0.1, 0.1, 0.05], cells: [2, 2, 1], elements: hexahedra, order: 1, origin: [-0.05, -0.05, -0.025]}, axis: [1, 0, 0], angle: 180 deg, translation: [0.103, 0.01, 0]}
materials: {m: {type: isotropic, density: 500, young: 1e8, nu: 0.2}}
terms: [{type: contact, between: [a, b], stiffness: 1e10}]
time: {end: 0.01}
)");
  EXPECT_EQ(s.force(s.zero()).norm(), 0);
}

TEST(Contact, IsRefusedWithTheReason) {
  const auto message = [](const std::string& between) {
    std::string yaml = blocks("cells: [1, 1, 1]", "cells: [1, 1, 1]", 0);
    yaml.replace(yaml.find("[lower.z1, upper.z0]"), 20, between);
    try {
      const BuiltTestScene s(yaml);
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  using testing::HasSubstr;
  EXPECT_EQ(message("[lower.z1, upper.z0]"), "accepted");
  EXPECT_THAT(message("[lower.z1, lower.z1]"), HasSubstr("twice"));
  EXPECT_THAT(message("[lower.z1, lower.x0]"), HasSubstr("share nodes"));
  EXPECT_THAT(message("[lower.z1, upper.z9]"), HasSubstr("did you mean 'upper.z0'?"));
  EXPECT_THAT(message("[lower.z1, uper]"), HasSubstr("no surface or region 'uper'; did you mean 'upper'?"));
  EXPECT_THAT(message("[lower.z1, all]"), HasSubstr("a region for its whole outer surface (lower, upper)"));
  const std::string ground = ", stiffness: 1, name: a}, {type: ground_contact, stiffness: 1, name: ";
  EXPECT_EQ(message("[lower.z1, upper.z0]" + ground + "b}, {type: contact, between: [lower.z1, upper.z0]"), "accepted");
  EXPECT_THAT(message("[lower.z1, upper.z0]" + ground + "a}, {type: contact, between: [lower.z1, upper.z0]"),
              HasSubstr("'a' is used twice among contacts"));
}

}  // namespace
}  // namespace orthodyn::contact_test
