// Andrews' squeezer, configs/cases/andrews_squeezer.yaml: seven rigid bodies of given inertia in three loops, against
// the end state of the test set for IVP solvers (F. Mazzia & C. Magherini, release 2.4, 2008, problem "andrews";
// computed there with tolerances of 1e-14).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::squeezer_test {
namespace {

const double kPi = std::acos(-1.0);

struct Angle {
  const char* joint;
  double start, end, rate;  // rad, rad, rad/s
};
// In the order of the joints.
constexpr std::array<Angle, 7> kAngles{{{"beta", -0.0617138900142764496, 0.1581077119629904e2, 0.1139920302151208e4},
                                        {"theta", 0, -0.1575637105984298e2, -0.1424379294994111e4},
                                        {"gamma", 0.455279819163070380, 0.4082224013073101e-1, 0.1103291221937134e2},
                                        {"phi", 0.222668390165885885, -0.5347301163226948, 0.1929337464421385e2},
                                        {"delta", 0.487364979543842550, 0.5244099658805304, 0.5735699284790808},
                                        {"omega", -0.222668390165885885, 0.5347301163226948, -0.1929337464421385e2},
                                        {"epsilon", 1.23054744454982119, 0.1048080741042263e1, 0.3231791658026955}}};

struct Force {
  const char* joint;
  double x, y;  // on the first body, N
};
constexpr std::array<Force, 3> kForces{{{"p3", 0.1991753333731910e3, -0.2975531228015052e2},
                                        {"p4", 0.2306654119098399e2, 0.3145271365475927e2},
                                        {"p6", 0.2264249232082739e2, 0.1161740700019673e2}}};

constexpr double kTurned = kAngles[0].end - kAngles[0].start;  // by the crank, rad
constexpr double kWork = 0.033 * kTurned;                      // of the torque, J

// Errors relative to the largest angle, rate and force, and the drift of the energy relative to the work.
struct Errors {
  double angle = 0, rate = 0, force = 0, energy = 0;
};

Errors errors_of(const std::string& method, double rtol) {
  Config config = Config::from_file(ORTHODYN_SOURCE_DIR "/configs/cases/andrews_squeezer.yaml");
  config.set_yaml("integrator", fmt::format("{{type: {}, rtol: {}}}", method, rtol));
  const BuiltTestScene s(config);
  const FemModel& model = s.model();
  const auto angle = [&](const char* joint, const State& state) {
    return model.evaluate(std::string("coordinate.") + joint, state)[0];
  };
  double crank = 0, turned = 0;  // rad
  StepWatch watch([&](const State& state) {
    const double now = angle("beta", state);
    turned += std::remainder(now - crank, 2 * kPi);
    crank = now;
  });
  const auto integrator = s.scene.integrator->make(model, task_of(s.scene, s.built));
  EnergyMeter meter(model, *integrator);
  const Outcome outcome =
      run(model, *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&meter, &watch}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;

  const NodalExpansion nodal(model.parts(), outcome.last.t, outcome.last.q, outcome.last.v);
  Errors errors;
  errors.angle = std::abs(turned / kTurned - 1);  // with whole turns
  errors.energy = std::abs(meter.drift()) / kWork;
  for (std::size_t k = 0; k < kAngles.size(); ++k) {
    const Angle& published = kAngles[k];
    const double found = angle(published.joint, outcome.last);
    const double wrong = std::remainder(found - (published.end - published.start), 2 * kPi);
    errors.angle = std::max(errors.angle, std::abs(wrong) / kTurned);
    const double rate = model.parts().joints[k].coordinate->rate(nodal.u, nodal.u_rate);
    errors.rate = std::max(errors.rate, std::abs(rate - published.rate) / std::abs(kAngles[1].rate));
  }
  for (const Force& published : kForces) {
    const auto found = model.evaluate(std::string("joint.") + published.joint, outcome.last);
    errors.force = std::max(errors.force, std::hypot(found[0] - published.x, found[1] - published.y) / kForces[0].x);
  }
  return errors;
}

struct Method {
  std::string integrator;
  int order;
  double rtol;  // the smallest
  double loose = 1e-5, factor = 100;
};
class Squeezer : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, Squeezer,
                         testing::Values(Method{"ida_bdf, max_order: 2", 2, 1e-7}, Method{"ida_bdf", 5, 1e-9},
                                         Method{"cvode_bdf, max_order: 2", 2, 1e-7},
                                         Method{"cvode_bdf", 5, 1e-9, 1e-7, 250}, Method{"generalized_alpha", 2, 1e-7},
                                         Method{"hht_alpha", 2, 1e-7}));

// A step of a method of order p has the error h^(p+1), and the motion the error h^p = rtol^(p/(p+1)).
TEST_P(Squeezer, EndsInThePublishedState) {
  const auto& [integrator, order, rtol, loose_rtol, factor] = GetParam();
  const double power = order / (order + 1.0);
  const auto expect_below = [&](const Errors& errors, double limit) {
    EXPECT_LE(errors.angle, limit);
    EXPECT_LE(errors.rate, limit);
    EXPECT_LE(errors.force, limit);
    EXPECT_LE(errors.energy, limit);
  };
  const Errors loose = errors_of(integrator, loose_rtol), tight = errors_of(integrator, rtol);
  expect_below(loose, factor * std::pow(loose_rtol, power));
  expect_below(tight, factor * std::pow(rtol, power));
  const auto observed = [&](double Errors::*error) {
    return std::log(loose.*error / tight.*error) / std::log(loose_rtol / rtol);
  };
  for (const auto error : {&Errors::angle, &Errors::rate, &Errors::force}) EXPECT_NEAR(observed(error), power, 0.25);
}

}  // namespace
}  // namespace orthodyn::squeezer_test
