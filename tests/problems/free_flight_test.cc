// Free bodies: with the exact force, energy and momentum are constant up to the integrator's error; with the warped
// force they grow.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "lib/mesh/box.h"
#include "tests/contract/order.h"
#include "tests/problems/running.h"

namespace orthodyn::free_flight_test {
namespace {

struct Flight {
  std::string spin = "[0, 0, 0]";  // rad/s
  double stretch = 1.2, end = 20, rtol = 1e-7;
  int max_order = 5, cells = 2;
  std::string corotation = "exact", young = "[10, 1, 1]", integrator = "cvode_bdf";
  std::string mesh = "split: six, order: 1", formulation = "auto";
};

BuiltTestScene scene_of(const Flight& f) {
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [1, 1, 1], cells: [{0}, {0}, {0}], {10}}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: {1}, nu: 0.3}}}}
regions: {{body: {{material: m, formulation: {11}, axes: {2}}}}}
elasticity: {{corotation: {3}}}
initial: {{spin: {4}, deformation_gradient: [[{5}, 0, 0], [0, 1, 0], [0, 0, 1]]}}
integrator: {{type: {6}, rtol: {7}, max_order: {8}}}
time: {{end: {9}}}
)",
                                    f.cells, f.young, kTurnedAxes, f.corotation, f.spin, f.stretch, f.integrator,
                                    f.rtol, f.max_order, f.end, f.mesh, f.formulation));
}

// Largest changes over the run: energy relative to the initial one; angular momentum relative to
// m v L / 2 with the largest rms speed v; linear momentum relative to m v.
struct Drift {
  double energy = 0, angular = 0, linear = 0;
  std::vector<double> energy_over_time, angular_over_time;
};

Drift drift(const Flight& flight, int frames = 100) {
  const auto scene = scene_of(flight);
  double energy = 0, speed = 0;
  Vec3 L = Vec3::Zero(), P = Vec3::Zero();
  Drift d;
  const auto outcome = run_scene(scene, frames, [&](const State& state) {
    if (state.t == 0) {
      energy = total_energy(scene, state);
      L = momentum(scene, "angular", state);
      P = momentum(scene, "linear", state);
    }
    speed = std::max(speed, std::sqrt(2 * scene.scalar("energy.kinetic", state.q, state.v)));
    d.energy_over_time.push_back(total_energy(scene, state) / energy - 1);
    d.energy = std::max(d.energy, std::abs(d.energy_over_time.back()));
    d.angular_over_time.push_back((momentum(scene, "angular", state) - L).norm());
    d.angular = std::max(d.angular, d.angular_over_time.back());
    d.linear = std::max(d.linear, (momentum(scene, "linear", state) - P).norm());
  });
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  d.angular /= 0.5 * speed;
  d.linear /= speed;
  return d;
}

TEST(FreeFlight, DriftsOfEnergyAndAngularMomentumFallWithTheTolerance) {
  const auto fly = [](int order, double rtol) {
    return drift({.spin = "[0.5, 1, 2]", .end = 5, .rtol = rtol, .max_order = order, .cells = 1});
  };
  for (const int order : {2, 5}) {
    expect_order(order, [&](double rtol) { return fly(order, rtol).energy; });
    expect_order(order, [&](double rtol) { return fly(order, rtol).angular; });
  }
}

TEST(FreeFlight, KeepsLinearMomentumToRoundOffAtAnyTolerance) {
  EXPECT_LE(drift({.spin = "[0.5, 1, 2]", .rtol = 1e-3, .max_order = 2}).linear, 1e-12);
}

class FreeFlightOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Elements, FreeFlightOf,
                         testing::Values("elements: hexahedra, order: 1", "elements: wedges, order: 1",
                                         "elements: hexahedra", "elements: hexahedra_27", "elements: wedges",
                                         "elements: wedges_18"));

TEST_P(FreeFlightOf, HexahedraOrWedgesKeepsEnergyAndMomenta) {
  for (const char* formulation : {"displacement", "mixed"}) {
    const Drift d =
        drift({.spin = "[0.5, 1, 2]", .end = 3, .cells = 1, .mesh = GetParam(), .formulation = formulation}, 20);
    EXPECT_LE(d.angular, 1e-5) << formulation;
    EXPECT_LE(d.energy, 1e-3) << formulation;
    EXPECT_LE(d.linear, 1e-12) << formulation;
  }
}

// Angular momentum is conserved to 100 rtol.
TEST(FreeFlight, ReleasedAtRestTheBodyDoesNotBeginToSpin) {
  const Drift exact = drift({});
  EXPECT_LE(exact.angular, 1e-5);
  EXPECT_LE(exact.energy, 1e-3);
}

TEST(FreeFlight, ReleasedAtRestTheWarpedForceGainsEnergyAndSpins) {
  const Drift warped = drift({.corotation = "warped"});
  EXPECT_GE(warped.angular, 0.1);
  EXPECT_GE(warped.energy, 0.1);
}

TEST(FreeFlight, OfAnIsotropicBodyTheWarpedForceIsTheExactOne) {
  const Drift exact = drift({.end = 3, .young = "[1, 1, 1]"}, 10);
  const Drift warped = drift({.end = 3, .corotation = "warped", .young = "[1, 1, 1]"}, 10);
  for (std::size_t i = 0; i < exact.energy_over_time.size(); ++i)
    EXPECT_NEAR(exact.energy_over_time[i], warped.energy_over_time[i], 1e-7);
}

// For 50 revolutions the drift grows no faster than linearly in time, and falls
// with rtol.
TEST(SpinningCube, DriftOverFiftyRevolutionsIsLinearAndFallsWithTheTolerance) {
  const double end = 50 * 2 * std::numbers::pi / 2;
  const auto at = [&](double rtol) {
    return drift({.spin = "[0, 0, 2]",
                  .stretch = 1,
                  .end = end,
                  .rtol = rtol,
                  .max_order = 5,
                  .cells = 1,
                  .young = "[10, 3, 1]"});
  };
  const Drift loose = at(1e-6), tight = at(1e-8);
  for (const auto& d : {loose, tight}) {
    const auto halfway = d.energy_over_time.size() / 2;
    const auto largest = [](auto first, auto last) {
      double m = 0;
      for (; first != last; ++first) m = std::max(m, std::abs(*first));
      return m;
    };
    const auto& e = d.energy_over_time;
    const auto split = e.begin() + static_cast<std::ptrdiff_t>(halfway);
    EXPECT_LE(largest(split, e.end()), 3 * largest(e.begin(), split));  // linear: 2, quadratic: 4
  }
  EXPECT_GE(std::log10(loose.energy / tight.energy) / 2, 5.0 / 6 - 0.15);
  EXPECT_GE(std::log10(loose.angular / tight.angular) / 2, 5.0 / 6 - 0.15);
  EXPECT_LE(tight.energy, 1e-3);
}

// Rotating a problem rotates its trajectory.
TEST(FreeFlight, OfATurnedBodyIsTheTurnedFlight) {
  const double rtol = 1e-6;
  const Mat3 R = Eigen::AngleAxisd(0.9, Vec3(3, -1, 2).normalized()).toRotationMatrix();
  const auto fly = [&](const Mat3& turn) {
    given_mesh() = make_box({.cells = {2, 1, 1}});
    for (Vec3& X : given_mesh().nodes) X = turn * X;
    const auto text = [](const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); };
    Mat3 F = Mat3::Identity();
    F(0, 0) = 1.1;
    F = Mat3(turn * F * turn.transpose());
    const BuiltTestScene scene(fmt::format(R"(
mesh: {{type: given}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {{first: {}, second: {}}}}}}}
gravity: {}
initial: {{spin: {}, deformation_gradient: [{}, {}, {}]}}
integrator: {{type: cvode_bdf, rtol: {}, max_order: 2, position_scale: 0.1, velocity_scale: 1}}
time: {{end: 1}}
)",
                                           fibre_material(10), text(turn * Vec3(0.6, 0.8, 0)),
                                           text(turn * Vec3(-0.8, 0.6, 0)), text(turn * Vec3(0, 0, -1)),
                                           text(turn * Vec3(0.5, 1, 2)), text(F.row(0)), text(F.row(1)), text(F.row(2)),
                                           rtol));
    const auto outcome = run_scene(scene, 1, [](const State&) {});
    EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    return scene.nodal(outcome.last.q);
  };
  const NodalVector u = fly(Mat3::Identity()), turned = fly(R);
  EXPECT_LE((R * u - turned).cwiseAbs().maxCoeff(), 100 * rtol * 0.1);
}

}  // namespace
}  // namespace orthodyn::free_flight_test
