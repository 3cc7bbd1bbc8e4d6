// Natural frequencies against bar and beam theory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "lib/linear/solver.h"
#include "tests/problems/running.h"

namespace orthodyn::vibration_test {
namespace {

// Frequency (Hz) of the lowest mode that is not orthogonal to `start`, by inverse iteration.
struct Mode {
  double frequency;
  Vector shape;
};

Mode inverse_iteration(const BuiltTestScene& s, Vector x) {
  Linearization at;
  s.model().linearize(0, s.zero(), s.zero(), TangentKind::exact, at);
  const auto solver = make_linear_solver("cholesky");
  solver->analyze(s.model().pattern());
  EXPECT_EQ(solver->factor(at.stiffness.data()), FactorStatus::ok);
  Vector Mx(x.size()), y(x.size());
  double omega_squared = 0, before = 1;
  while (std::abs(omega_squared - before) > 1e-12 * omega_squared) {
    before = omega_squared;
    s.model().multiply_mass(x, Mx);
    solver->solve(Mx, y);
    omega_squared = x.dot(Mx) / y.dot(Mx);  // Rayleigh's quotient, from the flexibility
    x = y / y.norm();
  }
  return {std::sqrt(omega_squared) / (2 * std::numbers::pi), x};
}

std::string spruce_box(const std::string& size, const std::string& cells, const std::string& split, double nu,
                       const std::string& rest) {
  return fmt::format(R"(
mesh: {{type: box, size: {}, cells: {}, split: {}, order: 1}}
materials:
  spruce: {{type: orthotropic, density: 400, young: [10.8e9, 0.84e9, 0.46e9], nu12: {}, nu23: {}, nu31: {},
           g12: 0.69e9, g23: 0.032e9, g13: 0.66e9}}
{})",
                     size, cells, split, nu, nu, 0.0225 / 0.44 * nu, rest);
}

// A bar with zero Poisson ratios that moves along its axis only.
BuiltTestScene bar(int cells, const std::string& mass) {
  return BuiltTestScene(spruce_box("[1, 0.05, 0.05]", fmt::format("[{}, 1, 1]", cells), "six", 0,
                                   fmt::format(R"(
mass: {}
clamps: [{{surface: x0}}, {{box: {{min: [0, 0, 0], max: [1, 1, 1]}}, components: [y, z]}}]
integrator: {{type: cvode_bdf, rtol: 1e-7, max_order: 2, position_scale: 1e-3, velocity_scale: 8}}
time: {{end: {}}}
)",
                                               mass, 1 / 1299.0381)));
}

const auto kStretch = [](const Vec3& X) { return Vec3(X[0], 0, 0); };

// Errors of f1 = sqrt(E1/rho) / (4 L) that an independent program has on this
// mesh; in one dimension they are +-(pi h / 4 L)^2 / 6.
TEST(Bar, FirstFrequencyHasTheKnownErrorOfEachMassMatrix) {
  const double exact = std::sqrt(10.8e9 / 400) / 4;
  struct Row {
    int cells;
    const char* mass;
    double error;
  };
  for (const auto& row : {Row{10, "consistent", 9.1e-4}, Row{10, "lumped", -1.1e-3}, Row{20, "consistent", 2.3e-4},
                          Row{20, "lumped", -2.9e-4}}) {
    const auto scene = bar(row.cells, row.mass);
    const double error = inverse_iteration(scene, scene.dofs(kStretch)).frequency / exact - 1;
    EXPECT_NEAR(error, row.error, 0.1 * std::abs(row.error)) << row.mass << " " << row.cells;
  }
}

// Released in the first mode. After one exact period the phase error is 2 pi times the relative error of f1; with its
// cosine taken into account, only the integrator's error remains.
TEST(Bar, AReleasedFirstModeSwingsAtItsFrequency) {
  for (const char* mass : {"consistent", "lumped"}) {
    auto scene = bar(10, mass);
    const Mode mode = inverse_iteration(scene, scene.dofs(kStretch));
    scene.built.initial.q = 1e-3 * mode.shape / mode.shape.lpNorm<Eigen::Infinity>();
    const double w = 2 * std::numbers::pi * mode.frequency;
    double largest = 0;
    const auto outcome = run_scene(scene, 20, [&](const State& state) {
      const Vector expected = std::cos(w * state.t) * scene.built.initial.q;
      largest = std::max(largest, (state.q - expected).lpNorm<Eigen::Infinity>());
    });
    EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    // rtol^(2/3) = 2e-5 of the amplitude, times about ten for one period.
    EXPECT_LE(largest, 3e-4 * 1e-3) << mass;
  }
}

// Linear tetrahedra are stiff in bending: 12 % and 3 % too high on these meshes. Richardson's
// extrapolation takes the error of second order out; of the fourth order, the square of the coarse
// mesh's 12 %, a part of some tenths remains.
TEST(Cantilever, FirstBendingFrequencyExtrapolatesToTimoshenkosBeam) {
  const double timoshenko = 41.5729;
  const auto frequency = [](int along, int across) {
    const BuiltTestScene scene(spruce_box("[1, 0.05, 0.05]", fmt::format("[{}, {}, {}]", along, across, across), "five",
                                          0.44, "mass: consistent\nclamps: [{surface: x0}]\ntime: {end: 1}"));
    return inverse_iteration(scene, scene.dofs([](const Vec3& X) { return Vec3(0, X[0] * X[0], 0); })).frequency;
  };
  const double coarse = frequency(40, 2), fine = frequency(80, 4);
  const double extrapolated = fine - (coarse - fine) / 3;
  EXPECT_GT(coarse, fine);
  EXPECT_GT(fine, timoshenko);
  EXPECT_NEAR(extrapolated, timoshenko, 0.01 * timoshenko) << coarse << " " << fine;
}

// Released as the bar, with corotational kinematics; at an amplitude of 1e-4 L large rotations have no effect.
TEST(Cantilever, AReleasedFirstModeSwingsAtItsFrequency) {
  const auto beam = [](double end) {
    return BuiltTestScene(spruce_box("[1, 0.05, 0.05]", "[20, 2, 2]", "five", 0.44,
                                     fmt::format(R"(
clamps: [{{surface: x0}}]
integrator: {{type: cvode_bdf, rtol: 1e-6, max_order: 2, position_scale: 1e-4, velocity_scale: 0.03}}
time: {{end: {}}}
)",
                                                 end)));
  };
  const auto guess = [](const Vec3& X) { return Vec3(0, X[0] * X[0], 0); };
  const auto still = beam(1);
  const Mode mode = inverse_iteration(still, still.dofs(guess));
  auto scene = beam(1 / mode.frequency);
  scene.built.initial.q = 1e-4 * mode.shape / mode.shape.lpNorm<Eigen::Infinity>();
  double largest = 0;
  const auto outcome = run_scene(scene, 20, [&](const State& state) {
    const Vector expected = std::cos(2 * std::numbers::pi * mode.frequency * state.t) * scene.built.initial.q;
    largest = std::max(largest, (state.q - expected).lpNorm<Eigen::Infinity>());
  });
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  // rtol^(2/3) = 1e-4 of the amplitude, times about ten for one period.
  EXPECT_LE(largest, 2e-3 * 1e-4);
}

}  // namespace
}  // namespace orthodyn::vibration_test
