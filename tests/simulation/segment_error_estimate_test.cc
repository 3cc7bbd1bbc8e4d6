// Estimates of accumulated integration errors, where the error is known.
#include "lib/simulation/error_estimate/segment_error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/simulation/run/run.h"

namespace orthodyn::segment_error_estimate_test {
namespace {

// One unknown: the corner of a cell, which moves along x (configs/cases/one_node_oscillator.yaml).
//   omega = sqrt(10 K/rho)/a, K = C33 + G13 + G23; here nu = 0: K = E3 + G13 + G23.
constexpr double kDensity = 1000, kSize = 0.1, kYoung = 1e6;  // shear moduli E/2
const double kOmega = std::sqrt(10 * 2 * kYoung / kDensity) / kSize;
const double kPeriod = 2 * M_PI / kOmega;

std::string oscillator(int periods, const std::string& rest) {
  return fmt::format(R"(
mesh: {{type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], order: 1}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0}}}}
elasticity: {{kinematics: linear}}
mass: consistent
initial: {{velocity: [1, 0, 0]}}
clamps: [{{surface: x0}}, {{surface: y0}}, {{surface: z0}}, {{nearest: [0.1, 0.1, 0.1], components: [y, z]}}]
time: {{end: {}}}
{})",
                     periods * kPeriod, rest);
}

std::optional<SegmentErrorEstimate> error_of(const std::string& scene) {
  const Setup setup = set_up(Config::from_text(scene));
  SegmentRecorder recorder(*setup.built.model);
  const double end = setup.scene.time.end;
  const Plan plan{end, evenly_spaced(0, end, 200), false};
  const std::atomic<bool> never{false};
  const Outcome outcome = run(*setup.built.model, *setup.integrator, setup.built.initial, plan, {&recorder}, never);
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  return segment_error_estimate(setup, *setup.integrator, recorder, end, never);
}

// The trapezoidal rule advances the phase by 2 atan(omega h/2) per step.
TEST(SegmentErrorEstimate, IsThePhaseOfTheTrapezoidalRule) {
  for (const int steps_per_period : {40, 100}) {
    constexpr int kPeriods = 100;
    const double omega_h = 2 * M_PI / steps_per_period;
    const double lag = (omega_h - 2 * std::atan(omega_h / 2)) * kPeriods * steps_per_period;  // rad
    const auto error = error_of(
        oscillator(kPeriods, fmt::format("integrator: {{type: newmark, step: {}}}", kPeriod / steps_per_period)));
    ASSERT_TRUE(error);
    EXPECT_GT(error->error, lag / 3) << steps_per_period;
    EXPECT_LT(error->error, lag * 3) << steps_per_period;
  }
}

// In a damped vibration errors decay: at most those of the last 1/(xi omega) remain.
TEST(SegmentErrorEstimate, OfADampedMotionIsNoMoreThanThatOfItsLastMoments) {
  constexpr int kPeriods = 100, kSteps = 40;
  const double omega_h = 2 * M_PI / kSteps, xi = 0.05;
  const double lag_per_radian = (omega_h - 2 * std::atan(omega_h / 2)) / omega_h;
  const auto error =
      error_of(oscillator(kPeriods, fmt::format("damping: {{stiffness: {}}}\nintegrator: {{type: newmark, step: {}}}",
                                                2 * xi / kOmega, kPeriod / kSteps)));
  ASSERT_TRUE(error);
  EXPECT_LT(error->error, 3 * lag_per_radian / xi);
}

// The run's error is estimated independently of small scales.
TEST(SegmentErrorEstimate, FallsWithTheToleranceByGivenScales) {
  const auto by = [](double rtol) {
    return error_of(
               oscillator(
                   200, fmt::format("integrator: {{type: cvode_bdf, rtol: {}, position_scale: {}, velocity_scale: 1}}",
                                    rtol, 1 / kOmega)))
        .value()
        .error;
  };
  const double loose = by(1e-4), tight = by(1e-7);
  EXPECT_LT(tight, 0.05 * loose);
  EXPECT_GT(loose, 1e-3);
}

TEST(SegmentErrorEstimate, OfAShortRunIsNotTold) {
  EXPECT_FALSE(error_of(oscillator(2, "integrator: {type: newmark, step: " + std::to_string(kPeriod / 100) + "}")));
}

}  // namespace
}  // namespace orthodyn::segment_error_estimate_test
