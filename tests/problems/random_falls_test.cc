// Three boxes of random sizes, places, velocities and spins fall onto each other and onto the ground: none is ever
// inside another one, and the energy never rises. Every other fall is of rigid bodies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "lib/fem/contact/contact.h"
#include "lib/fem/contact/contact_input.h"
#include "tests/material/constants.h"
#include "tests/problems/running.h"

namespace orthodyn::random_falls_test {
namespace {

constexpr double kTolerance = 1e-4;
constexpr std::array<const char*, 3> kNames{"b0", "b1", "b2"};

std::string text_of(const Vec3& x) { return fmt::format("[{:.8f}, {:.8f}, {:.8f}]", x[0], x[1], x[2]); }

// Of a rigid motion with the velocity v at `centre` and the spin w, as formulas of x, y and z.
std::array<std::string, 3> velocity_field(const Vec3& v, const Vec3& w, const Vec3& centre) {
  std::array<std::string, 3> out;
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    out[static_cast<std::size_t>(c)] = fmt::format("({:.8f}) + ({:.8f})*({} - ({:.8f})) - ({:.8f})*({} - ({:.8f}))",
                                                   v[c], w[a], "xyz"[b], centre[b], w[b], "xyz"[a], centre[a]);
  }
  return out;
}

// Each box lies above the one below it, by their largest half diagonals.
std::string scene_of(unsigned seed) {
  Random random(seed);
  const bool are_rigid = seed % 2 == 0;
  const double friction = random.between(0, 1) < 0.5 ? 0 : random.between(0.1, 0.7);
  std::string bodies;
  std::array<std::string, 3> fields;
  double top = 0.02;
  for (const char* name : kNames) {
    const Vec3 size(random.between(0.05, 0.14), random.between(0.05, 0.14), random.between(0.05, 0.14));
    const double half = size.norm() / 2;
    const Vec3 centre(random.between(-0.04, 0.04), random.between(-0.04, 0.04), top + half);
    bodies += fmt::format(
        "    {}: {{mesh: {{type: box, size: {}, cells: [{}], elements: hexahedra, order: 1, origin: {}}}, axis: {}, "
        "angle: {:.8f} rad, translation: {}}}\n",
        name, text_of(size), are_rigid ? "1, 1, 1" : "2, 2, 2", text_of(-size / 2), text_of(random.vector()),
        random.between(0, std::numbers::pi), text_of(centre));
    const auto field = velocity_field({random.between(-0.5, 0.5), random.between(-0.5, 0.5), -random.between(0, 3)},
                                      8 * random.vector(), centre);
    const double above = top + 2 * half + 0.0025;
    for (std::size_t c = 0; c < 3; ++c)
      fields[c] += name == kNames.back() ? field[c] : fmt::format("z < {:.8f} ? {} : ", above, field[c]);
    top += 2 * half + 0.005;
  }
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
{}materials: {{m: {{type: isotropic, density: 500, young: 1e7, nu: 0.3}}}}
regions: {{all: {{material: m{}}}}}
gravity: [0, 0, -9.81]
initial: {{velocity_field: ["{}", "{}", "{}"]}}
terms:
  - {{type: ground_contact, stiffness: 2e8, friction: {}}}
  - {{type: barrier_contact, between: [b0, b1], stiffness: 2e8, friction: {}}}
  - {{type: barrier_contact, between: [b1, b2], stiffness: 2e8, friction: {}}}
  - {{type: barrier_contact, between: [b2, b0], stiffness: 2e8, friction: {}}}
time: {{end: 0.6}}
integrator: {{rtol: {}}}
)",
                     bodies, are_rigid ? ", rigid: true" : "", fields[0], fields[1], fields[2], friction, friction,
                     friction, friction, kTolerance);
}

// The winding number of the closed surface about a point: 1 inside, 0 outside.
double winding(const ContactSurface& surface, const NodalVector& x, const Vec3& point) {
  double sum = 0;
  for (const auto& corners : surface.triangles()) {
    const Vec3 a = x.col(corners[0]) - point, b = x.col(corners[1]) - point, c = x.col(corners[2]) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

// Whether a node of one surface, or a point of one of its edges, is inside the other one.
bool reaches_into(const ContactSurface& one, const ContactSurface& other, const NodalVector& x) {
  constexpr int kPoints = 8;  // of an edge
  const auto box = other.box(x);
  for (const auto& edge : one.edges())
    for (int k = 0; k <= kPoints; ++k) {
      const double s = static_cast<double>(k) / kPoints;
      const Vec3 point = (1 - s) * x.col(edge.nodes[0]) + s * x.col(edge.nodes[1]);
      if (box.contains(point) && winding(other, x, point) > 0.5) return true;
    }
  return false;
}

class Falls : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Few, Falls, testing::Range(1u, 13u));
INSTANTIATE_TEST_SUITE_P(Many, Falls, testing::Range(13u, 501u));

TEST_P(Falls, KeepBodiesApartAndDoNotGainEnergy) {
  const std::string scene = scene_of(GetParam());
  SCOPED_TRACE(scene);
  const BuiltTestScene s(scene);
  std::vector<ContactSurface> surfaces;
  for (const char* name : kNames) surfaces.push_back(contact_surface(s.mesh(), name, {}));
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  const double start = total_energy(s, s.built.initial);
  double highest = start, kinetic = 0, entered = -1, touched = 0;
  StepWatch watch([&](const State& state) {
    highest = std::max(highest, total_energy(s, state));
    kinetic = std::max(kinetic, s.model().evaluate("energy.kinetic", state)[0]);
    for (const auto& term : s.model().parts().loads)
      if (term->contact() && term->contact()->refuses_crossing()) {
        const NodalVector x = s.positions(state.q), u = x - *s.model().parts().rest, v = NodalVector::Zero(3, x.cols());
        touched = std::max(touched, term->energy({state.t, x, u, v}));
      }
    const NodalVector x = s.positions(state.q);
    for (const auto& one : surfaces)
      for (const auto& other : surfaces)
        if (&one != &other && entered < 0 && reaches_into(one, other, x)) entered = state.t;
  });
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&watch}, {false});
  ASSERT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_LT(entered, 0) << "inside another body at " << entered << " s";
  EXPECT_LE(highest - start, 10 * kTolerance * kinetic);
  if (touched == 0) GTEST_SKIP() << "these boxes miss each other";
}

}  // namespace
}  // namespace orthodyn::random_falls_test
