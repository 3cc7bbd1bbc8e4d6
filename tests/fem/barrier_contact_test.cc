// Contact by a barrier: distances of edges, derivatives, resultants, pressure, notches, crossing surfaces, contact of a
// body with itself, and input that is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/limit_error.h"
#include "lib/fem/contact/barrier.h"
#include "lib/fem/contact/near_features.h"
#include "lib/fem/contact/passing_time.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::barrier_contact_test {
namespace {

using testing::HasSubstr;

TEST(Barrier, HasItsDerivativesAndTwoContinuousOnesAtTheGap) {
  for (const double s : {0.01, 0.2, 0.7, 0.95}) {
    expect_derivative([&](double h) { return one(barrier(s + h * s / 10)); }, one(barrier_slope(s) * s / 10));
    expect_derivative([&](double h) { return one(barrier_slope(s + h * s / 10)); }, one(barrier_curvature(s) * s / 10));
  }
  const double s = 1 - 1e-6;
  EXPECT_NEAR(barrier(s) / 1e-18, 1, 1e-5);
  EXPECT_NEAR(barrier_slope(s) / -3e-12, 1, 1e-5);
  EXPECT_NEAR(barrier_curvature(s) / 6e-6, 1, 1e-5);
  EXPECT_EQ(barrier(1.1) + barrier_slope(1.1) + barrier_curvature(1.1), 0);
  EXPECT_GT(barrier(1e-100), 100);
}

struct Pair {
  const char* name;
  double first, second;  // the nearest places
  Segment other;         // beside the segment from the origin to (1, 0, 0)
};
class NearestPlacesOf : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(
    Pairs, NearestPlacesOf,
    testing::Values(Pair{"crossed", 0.4, 0.5, (Segment() << 0.3, 0.5, -1, 1, 0.2, 0.2).finished()},
                    Pair{"end_of_first", 1, 0.5, (Segment() << 1.4, 1.4, -1, 1, 0.2, 0.2).finished()},
                    Pair{"end_of_second", 0.4, 0, (Segment() << 0.4, 0.5, 0.3, 1, 0.2, 0.2).finished()},
                    Pair{"ends", 1, 0, (Segment() << 1.4, 1.7, 0.3, 1, 0.2, 0.2).finished()}),
    [](const testing::TestParamInfo<Pair>& tested) { return std::string(tested.param.name); });

Segment segment_of(const Vec12& z, int k) {
  Segment out;
  out << z.segment<3>(6 * k), z.segment<3>(6 * k + 3);
  return out;
}

Distance distance(const Vec12& z) {
  const Segment first = segment_of(z, 0), second = segment_of(z, 1);
  return distance_of(first, second, nearest_places(first, second));
}

Vec12 coordinates(const Segment& other) {
  Vec12 z;
  z << Vec3::Zero(), Vec3::UnitX(), other.col(0), other.col(1);
  return z;
}

TEST_P(NearestPlacesOf, AreNearerThanAllOthers) {
  const Vec12 z = coordinates(GetParam().other);
  const Segment first = segment_of(z, 0), second = segment_of(z, 1);
  const auto [s, t] = nearest_places(first, second);
  EXPECT_NEAR(s, GetParam().first, 1e-15);
  EXPECT_NEAR(t, GetParam().second, 1e-15);
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) {
      const Vec3 a = first.col(0) + i / 20.0 * (first.col(1) - first.col(0)),
                 b = second.col(0) + j / 20.0 * (second.col(1) - second.col(0));
      EXPECT_GE((a - b).norm(), distance(z).r - 1e-15);
    }
}

TEST_P(NearestPlacesOf, HaveTheDerivativesOfTheirDistance) {
  const Vec12 z = coordinates(GetParam().other);
  Random random(81);
  const Vec12 direction = random_dofs(random, 12, 1);
  const Distance at = distance(z);
  expect_derivative([&](double h) { return one(distance(z + h * direction).r); }, one(at.gradient().dot(direction)));
  expect_derivative([&](double h) { return Vector(distance(z + h * direction).gradient()); },
                    at.second_derivative() * direction / at.r);
}

TEST(Pierces, ATriangleInsideItsSidesOnly) {
  const Triangle t = (Triangle() << 0, 1, 0, 0, 0, 1, 0, 0, 0).finished();
  const auto at = [](double x, double y, double low, double high) {
    return (Segment() << x, x, y, y, low, high).finished();
  };
  EXPECT_TRUE(pierces(at(0.2, 0.3, -1, 0.1), t));
  EXPECT_TRUE(pierces(at(0.2, 0.3, 1, -0.1), t));
  EXPECT_FALSE(pierces(at(0.2, 0.3, 0.1, 1), t));
  EXPECT_FALSE(pierces(at(0.7, 0.7, -1, 1), t));
  EXPECT_FALSE(pierces(at(-0.1, 0.3, -1, 1), t));
  EXPECT_TRUE(pierces(at(0, 0.5, -1, 1), t)) << "side";
}

// Two blocks at the distance `apart`, the upper one turned by `angle` about the axis z.
std::string blocks(const std::string& cells, double apart, double angle, const std::string& law = "") {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 1, 0.5], {0}}}}}
    upper: {{mesh: {{type: box, size: [0.6, 0.6, 0.5], {0}}}, axis: [0, 0, 1], angle: {1} rad, translation: [0.37, 0.03, {2}]}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3}}}}
terms: [{{type: barrier_contact, between: [lower.z1, upper.z0], stiffness: 2000, gap: 0.05{3}}}]
time: {{end: 1}}
)",
                     cells, angle, 0.5 + apart, law);
}

class BarrierContactOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Elements, BarrierContactOf,
                         testing::Values("cells: [3, 2, 1], order: 1", "cells: [2, 3, 1]",
                                         "cells: [3, 2, 1], elements: hexahedra, order: 1",
                                         "cells: [2, 1, 1], elements: hexahedra"));

TEST_P(BarrierContactOf, ForceAndTangentAreDerivatives) {
  const BuiltTestScene s(blocks(GetParam(), 0.03, 0.3)), apart(blocks(GetParam(), 0.2, 0.3));
  Random random(82);
  const Vector q = random_dofs(random, s.size(), 2e-3), d = random_dofs(random, s.size(), 0.005);
  EXPECT_GE((s.force(q) - apart.force(q)).norm(), 1e-2) << "no contact";
  expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
  expect_derivative([&](double h) { return s.force(q + h * d); }, -s.stiffness(q) * d);
}

// Edges of both blocks are nearly parallel, so that their weights change.
// With `slide`, the matrix couples the nodes of all pairs of points that may touch. A middle couples all nodes of its
// face.
TEST_P(BarrierContactOf, TangentsAreThoseOfAllTouchingNodesWithSlide) {
  const BuiltTestScene s(blocks(GetParam(), 0.03, 0.3, ", slide: 1.2"));
  Random random(88);
  const Vector q = random_dofs(random, s.size(), 1e-3), d = random_dofs(random, s.size(), 1e-3);
  expect_derivative([&](double h) { return s.force(q + h * d); }, -s.stiffness(q) * d);
}

TEST_P(BarrierContactOf, NearlyParallelEdgesHaveTheirDerivatives) {
  const BuiltTestScene s(blocks(GetParam(), 0.03, 0.02));
  Random random(83);
  const Vector q = random_dofs(random, s.size(), 1e-4), d = random_dofs(random, s.size(), 2e-3);
  expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
  expect_derivative([&](double h) { return s.force(q + h * d); }, -s.stiffness(q) * d);
}

TEST_P(BarrierContactOf, FrictionHasItsDerivativesAndDissipates) {
  const BuiltTestScene s(blocks(GetParam(), 0.03, 0.3, ", friction: 0.4, creep: 0.5")),
      smooth(blocks(GetParam(), 0.03, 0.3));
  Random random(84);
  const Vector q = random_dofs(random, s.size(), 2e-3), v = random_dofs(random, s.size(), 1),
               d = random_dofs(random, s.size(), 0.1);
  const Vector drag = s.force(q, v) - smooth.force(q, v);
  EXPECT_GE(drag.norm(), 1e-3);
  EXPECT_LE(std::abs(drag.sum()), 1e-12 * drag.norm());
  EXPECT_NEAR(s.scalar("power.dissipated", q, v), -drag.dot(v), 1e-12 * drag.norm() * v.norm());
  expect_derivative([&](double h) { return s.force(q, v + h * d); }, -s.matrix({0, 1, 0}, q, v) * d);
}

TEST_P(BarrierContactOf, ForcesHaveNoResultantAndNoTorque) {
  const BuiltTestScene s(blocks(GetParam(), 0.03, 0.3));
  Random random(85);
  const Vector q = random_dofs(random, s.size(), 2e-3);
  NodalVector f = NodalVector::Zero(3, s.positions(q).cols());
  s.model().parts().dofs->add_forces_to(s.force(q), f);
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) torque += Vec3(s.positions(q).col(i)).cross(Vec3(f.col(i)));
  EXPECT_LE(f.rowwise().sum().norm(), 1e-12 * f.norm());
  EXPECT_LE(torque.norm(), 1e-12 * f.norm());
}

// A corner of the upper block above the lower one: nodes at any place above a plane surface see it once, whether they
// are above a face, an edge or a node of it.
TEST(NearFeatures, CountAPlaneSurfaceOnce) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, 0.5, -1}};
  const std::vector<FaceCorners> fan{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 3), std::pair(3, 0)})
    mesh.cells.add(CellShape::tet4, std::vector<int>{a, b, 4, 5});
  const int n = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {0, 0, 3}});
  mesh.cells.add(CellShape::tet4, std::vector<int>{n, n + 1, n + 2, n + 3});
  const ContactSurface plane(mesh, fan), other(mesh, {{n, n + 2, n + 1}});
  NodalVector x(3, n + 4);
  for (Eigen::Index i = 0; i < n + 4; ++i) x.col(i) = mesh.nodes[static_cast<std::size_t>(i)];
  constexpr double kHeight = 0.05, kGap = 0.1;
  for (const Vec3& place : {Vec3(0.3, 0.2, kHeight), Vec3(0.25, 0.25, kHeight), Vec3(0.5, 0.5, kHeight),
                            Vec3(0.5, 0.48, kHeight), Vec3(0.52, 0.5, kHeight), Vec3(0, 0, kHeight)}) {
    x.col(n) = place;
    double energy = 0, area = 0;
    for (const NearPlace& near : NearFeatures(plane, other, kGap).at(x))
      if (near.parallel == 0 && near.points[0] == n) {
        energy += near.area * barrier(near.distance.r / kGap);
        area += near.area;
      }
    EXPECT_NEAR(energy, other.areas()[0].second * barrier(kHeight / kGap), 1e-14) << place.transpose();
    EXPECT_NEAR(area, other.areas()[0].second, 1e-14) << place.transpose();
  }
}

// In a notch of two faces, a node sees both of them, and its energy is continuous where the foot on one of them leaves.
TEST(NearFeatures, SeeBothSidesOfANotch) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0.8}, {0.5, -1, 0.8}, {0.5, 0, -1}};
  mesh.cells.add(CellShape::tet4, std::vector<int>{0, 1, 2, 4});
  mesh.cells.add(CellShape::tet4, std::vector<int>{1, 0, 3, 4});
  mesh.nodes.insert(mesh.nodes.end(), {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {0, 0, 3}});
  mesh.cells.add(CellShape::tet4, std::vector<int>{5, 6, 7, 8});
  const ContactSurface notch(mesh, {{0, 1, 2}, {1, 0, 3}}), other(mesh, {{5, 7, 6}});
  NodalVector x(3, 9);
  for (Eigen::Index i = 0; i < 9; ++i) x.col(i) = mesh.nodes[static_cast<std::size_t>(i)];
  constexpr double kGap = 0.2;
  const auto count = [&](const Vec3& place) {
    x.col(5) = place;
    int sides = 0;
    for (const NearPlace& near : NearFeatures(notch, other, kGap).at(x))
      sides += near.parallel == 0 && near.points[0] == 5 && near.area > 0;
    return sides;
  };
  EXPECT_EQ(count({0.5, 0, 0.1}), 2);
  EXPECT_EQ(count({0.5, 0.3, 0.29}), 1);
}

// The force on a small block above one face of a large one: the pressure of the closed form at the distance 0.6 gap, on
// half of the area, because the large block has no node below the small one.
TEST(BarrierContact, PressureIsThatOfTheDistance) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    lower: {mesh: {type: box, size: [1, 1, 0.5], cells: [1, 1, 1], elements: hexahedra, order: 1}}
    upper: {mesh: {type: box, size: [0.2, 0.2, 0.5], cells: [1, 1, 1], elements: hexahedra, order: 1}, translation: [0.15, 0.6, 0.53]}
materials: {m: {type: isotropic, density: 1, young: 10, nu: 0.3}}
terms: [{type: barrier_contact, between: [lower.z1, upper.z0], stiffness: 2000, gap: 0.05}]
time: {end: 1}
)");
  NodalVector f = NodalVector::Zero(3, s.positions(s.zero()).cols());
  s.model().parts().dofs->add_forces_to(s.force(s.zero()), f);
  const ContactSurface upper(s.mesh(), s.mesh().surfaces.at("upper.z0"));
  double own = 0;
  for (const auto& [node, of_node] : upper.areas()) own += f(2, node);
  const double slope = 1 / (0.6 * 0.6) - 3 + 2 * 0.6;       // -B'(0.6) of B(s) = 1/s - 3 + 3 s - s^2
  EXPECT_NEAR(own, 0.04 * 2000 * 0.05 * slope / 2, 1e-12);  // no edge of the upper block meets another
  const State rest{0, s.zero(), s.zero()};
  EXPECT_NEAR(s.model().evaluate("contact.contact_1", rest).at(2), -own, 1e-12);
  EXPECT_NEAR(s.model().evaluate("contact_pressure.contact_1", rest).at(0), 2000 * 0.05 * slope, 1e-9);
}

TEST(BarrierContact, RefusesStatesInWhichSurfacesCross) {
  const BuiltTestScene s(blocks("cells: [3, 2, 1], order: 1", 0.03, 0.3));
  for (const double down : {0.04, 0.12}) {  // the second one is beyond the gap behind the surface
    const Vector q = s.dofs([&](const Vec3& x) { return Vec3(0, 0, x[2] > 0.51 ? -down : 0); });
    EXPECT_THROW(s.force(q), RecoverableError) << down;
    EXPECT_THROW(s.potential(q), RecoverableError) << down;
  }
}

// A block whose ends can touch when it is bent.
std::string ring_of(const std::string& more) {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    ring: {{mesh: {{type: box, size: [0.4, 0.1, 0.3], cells: [8, 2, 6], order: 1}}}}
materials: {{m: {{type: isotropic, density: 1, young: 10, nu: 0.3}}}}
terms: [{{type: barrier_contact, between: [ring, ring], stiffness: 100{}}}]
time: {{end: 1}}
)",
                     more);
}

TEST(BarrierContact, OfABodyWithItselfHasItsDerivatives) {
  const BuiltTestScene s(ring_of(", gap: 0.02"));
  // Bent to nearly a closed ring.
  Vector q = s.dofs([](const Vec3& x) {
    const double angle = 6.1 * (x[0] / 0.4 - 0.5), radius = 0.4 / 6.1 + 0.3 - x[2];
    return Vec3(Vec3(radius * std::sin(angle), x[1], -radius * std::cos(angle)) - x);
  });
  Random random(86);
  q += random_dofs(random, s.size(), 1e-4);
  const Vector d = random_dofs(random, s.size(), 1e-3);
  const auto contact = s.model().only({s.model().force_parts().back()});
  EXPECT_THAT(s.model().force_parts().back(), HasSubstr("barrier contact of ring with itself"));
  const auto force = [&](const Vector& at) {
    Vector f(at.size());
    contact->force(0, at, s.zero(), f);
    return f;
  };
  Linearization at;
  contact->linearize(0, q, s.zero(), TangentKind::exact, at);
  std::vector<double> K(contact->pattern().row.size());
  contact->combine({0, 0, 1}, at, K.data());
  Vector change(s.size());
  contact->multiply_matrix(K.data(), d, change);
  EXPECT_EQ(force(s.zero()).norm(), 0);
  EXPECT_GT(force(q).norm(), 1e-6);
  expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
  expect_derivative([&](double h) { return force(q + h * d); }, -change);
}

// Friction of a bent strip that touches itself is against the sliding velocity, and its derivatives are the damping.
TEST(BarrierContact, OfABodyWithItselfHasFriction) {
  const BuiltTestScene s(ring_of(", gap: 0.02, friction: 0.3, creep: 0.1"));
  const Vector q = s.dofs([](const Vec3& x) {
    const double angle = 6.1 * (x[0] / 0.4 - 0.5), radius = 0.4 / 6.1 + 0.3 - x[2];
    return Vec3(Vec3(radius * std::sin(angle), x[1], -radius * std::cos(angle)) - x);
  });
  Random random(87);
  const Vector v = random_dofs(random, s.size(), 0.1), d = random_dofs(random, s.size(), 0.1);
  const auto contact = s.model().only({s.model().force_parts().back()});
  const auto force = [&](const Vector& at) {
    Vector f(at.size());
    contact->force(0, q, at, f);
    return f;
  };
  const Vector friction = force(v) - force(s.zero());
  EXPECT_GT(friction.norm(), 1e-6);
  EXPECT_LT(friction.dot(v), 0);
  Linearization at;
  contact->linearize(0, q, v, TangentKind::exact, at);
  std::vector<double> D(contact->pattern().row.size());
  contact->combine({0, 1, 0}, at, D.data());
  Vector change(s.size());
  contact->multiply_matrix(D.data(), d, change);
  expect_derivative([&](double h) { return force(v + h * d); }, -change);
}

// A block of which the far side touches later than `slide` allows has no force there, but an error.
TEST(BarrierContact, StopsWhereItsSlideIsTooSmall) {
  const BuiltTestScene s(blocks("cells: [3, 2, 1], order: 1", 0.03, 0, ", slide: 1"));
  const auto move = [&](double along) {
    return s.dofs([&](const Vec3& x) { return x[2] > 0.51 ? Vec3(along, 0, 0) : Vec3(Vec3::Zero()); });
  };
  EXPECT_GT(s.force(move(0)).norm(), 0);
  EXPECT_GT(s.force(move(-0.1)).norm(), 0);
  try {
    s.force(move(-0.9));
    ADD_FAILURE() << "accepted";
  } catch (const LimitError& e) {
    EXPECT_THAT(e.what(), HasSubstr("`slide` is 1 m"));
  }
}

TEST(BarrierContact, IsRefusedWithTheReason) {
  const auto message = [](const std::string& yaml) {
    try {
      const BuiltTestScene s(yaml);
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(message(blocks("cells: [2, 2, 1]", 0.03, 0.1)), "accepted");
  EXPECT_THAT(message(blocks("cells: [2, 2, 1]", 0, 0.1)), HasSubstr("at rest"));
  EXPECT_THAT(message(blocks("cells: [2, 2, 1]", 1e-14, 0.1)), HasSubstr("next to touching"));
  EXPECT_THAT(message(blocks("cells: [2, 2, 1]", -0.05, 0.1)), HasSubstr("cross"));
  EXPECT_EQ(message(ring_of("")), "accepted");
  const BuiltTestScene ring(ring_of(", name: gap"));
  const auto has = [&](const char* name) {
    const auto all = ring.model().outputs();
    return std::any_of(all.begin(), all.end(), [&](const OutputInfo& info) { return info.name == name; });
  };
  EXPECT_TRUE(has("contact_pressure.gap"));
  EXPECT_FALSE(has("contact.gap"));  // the sum of its forces is zero
  EXPECT_THAT(message(ring_of(", gap: 0.2")), HasSubstr("choose a smaller gap"));
}

// Bodies that approach at 2 m/s may move 0.4 of the way to the middle of a cell.
TEST(PassingTime, FollowsFromDistanceAndSpeed) {
  std::string yaml = blocks("cells: [1, 1, 1], elements: hexahedra, order: 1", 1, 0);
  yaml.replace(yaml.find("[0.37, 0.03,"), 12, "[0.2, 0.2,");
  const BuiltTestScene s(yaml);
  const ContactSurface lower(s.mesh(), s.mesh().surfaces.at("lower.z1")),
      upper(s.mesh(), s.mesh().surfaces.at("upper.z0"));
  NodalVector x = s.positions(s.zero()), v = NodalVector::Zero(3, x.cols());
  EXPECT_EQ(passing_time(lower, upper, 0.5, x, v), std::numeric_limits<double>::infinity());
  for (const auto& [node, area] : upper.areas()) v(2, node) = -2;
  EXPECT_NEAR(passing_time(lower, upper, 0.5, x, v), 0.4 * (1 + 0.5) / 2, 1e-12);
  // A rotation of both about the axis z does not count.
  for (Eigen::Index i = 0; i < x.cols(); ++i) v.col(i) += 50 * Vec3::UnitZ().cross(Vec3(x.col(i)));
  EXPECT_NEAR(passing_time(lower, upper, 0.5, x, v), 0.4 * (1 + 0.5) / 2, 1e-12);
}

}  // namespace
}  // namespace orthodyn::barrier_contact_test
