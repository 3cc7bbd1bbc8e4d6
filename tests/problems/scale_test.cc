// Scaling size, stiffness or density scales the motion exactly: an absolute threshold, ours or a library's, would
// violate this. Scale factors are powers of two, so that rounding is identical.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/analysis/buckling.h"
#include "lib/analysis/modes.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/contract/methods.h"
#include "tests/problems/running.h"

namespace orthodyn::scale_test {
namespace {

struct Units {
  double length, stress, density;  // m, Pa, kg/m^3
  double time() const { return length * std::sqrt(density / stress); }
  double force() const { return stress * length * length; }
};

double two_to(int power) { return std::exp2(power); }

// From 1e-9 to 1e4 m, 1 to 1e12 Pa, 1e-3 to 1e5 kg/m^3; the time scale is a power of two as well.
std::vector<Units> all_units() {
  return {{two_to(-30), two_to(37), two_to(11)}, {two_to(-30), two_to(0), two_to(16)},
          {two_to(13), two_to(40), two_to(-10)}, {two_to(13), two_to(0), two_to(16)},
          {two_to(-13), two_to(37), two_to(11)}, {two_to(-30), two_to(40), two_to(-10)}};
}

std::string bar(const Units& u, int fine) {
  return fmt::format(R"(
mesh: {{type: box, size: [{}, {}, {}], cells: [{}, {}, {}]}}
materials:
  m: {{type: orthotropic, density: {}, young: [{}, {}, {}], nu12: 0.3, nu23: 0.3, nu31: 0.02, g12: {}, g23: {}, g13: {}}}
regions: {{body: {{material: m, axes: {{first: [0.8, 0.6, 0], second: [-0.6, 0.8, 0]}}}}}}
clamps: [{{surface: x0}}]
)",
                     u.length, u.length / 4, u.length / 8, 3 * fine, fine, fine, u.density, u.stress, u.stress / 8,
                     u.stress / 16, u.stress / 16, u.stress / 64, u.stress / 32);
}

std::string load(const Units& u, const char* direction, double share) {
  return fmt::format("loads: [{{surface: x1, force: {}, factor: {{type: ramp, end: {}}}}}]\n",
                     fmt::format(fmt::runtime(direction), share * u.force()), u.time());
}

constexpr double kTolerance = 1e-8;

TEST(Scale, DoesNotChangeModes) {
  const auto figures = [](const Units& u) {
    const BuiltTestScene s(bar(u, 2) + fmt::format("time: {{end: {}}}\n", u.time()));
    EXPECT_GT(s.size(), 300);  // by iteration
    Vector lambda(8);
    const Modes modes = natural_modes(s.model(), {0, s.zero(), s.zero()}, 8);
    for (int k = 0; k < 8; ++k) lambda[k] = modes.modes[static_cast<std::size_t>(k)].lambda * u.time() * u.time();
    return lambda;
  };
  const Vector expected = figures({1, 1, 1});
  for (const Units& u : all_units())
    EXPECT_LT((figures(u) - expected).norm(), kTolerance * expected.norm()) << u.length;
}

TEST(Scale, DoesNotChangeBucklingFactors) {
  const auto figures = [](const Units& u) {
    const BuiltTestScene s(bar(u, 2) + load(u, "[-{}, 0, 0]", 1e-6) + fmt::format("time: {{end: {}}}\n", u.time()));
    Vector factors(3);
    const auto modes = buckling_modes(s.model(), s.zero(), u.time(), 3).modes;
    for (std::size_t k = 0; k < 3; ++k) factors[static_cast<Eigen::Index>(k)] = modes.at(k).load_factor;
    return factors;
  };
  const Vector expected = figures({1, 1, 1});
  for (const Units& u : all_units())
    EXPECT_LT((figures(u) - expected).norm(), kTolerance * expected.norm()) << u.length;
}

TEST(Scale, DoesNotChangeEquilibria) {
  const auto figures = [](const Units& u) {
    const BuiltTestScene s(bar(u, 1) + load(u, "[0, 0, {}]", 1e-4) +
                           fmt::format("analysis: static\ntime: {{end: {}}}\n", u.time()));
    return Vector(equilibrium(s.scene, s.built) / u.length);
  };
  const Vector expected = figures({1, 1, 1});
  for (const Units& u : all_units())
    EXPECT_LT((figures(u) - expected).norm(), kTolerance * expected.norm()) << u.length;
}

class ScaleOfMotions : public testing::TestWithParam<std::string> {};

TEST_P(ScaleOfMotions, DoesNotChangeThem) {
  const TestedMethod& method = tested(GetParam());
  const auto figures = [&](const Units& u) {
    std::string needs = method.needs;
    if (has_key(GetParam(), "step") && !controls_its_error(GetParam()))
      needs += fmt::format(", step: {}", u.time() / 64);
    const BuiltTestScene s(bar(u, 1) + load(u, "[0, 0, {}]", 1e-4) +
                           fmt::format("gravity: [0, 0, -{}]\n", 1e-5 * u.force() / std::pow(u.length, 3) / u.density) +
                           (method.linear_only ? "elasticity: {kinematics: linear}\n" : "") +
                           fmt::format("damping: {{stiffness: {}}}\ntime: {{end: {}}}\nintegrator: {{type: {}{}}}\n",
                                       u.time() / 64, 2 * u.time(), GetParam(), needs));
    Vector q;
    const Outcome outcome = run_scene(s, 2, [&](const State& state) { q = state.q / u.length; });
    EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    return q;
  };
  // Values a unit in the last place apart may be rounded to single precision differently. Where ARKODE's implicit
  // stages take one correction only, this remains.
  const bool is_single = GetParam() == "arkode_dirk" || GetParam() == "arkode_imex" || GetParam() == "auto";
  const double tolerance = is_single ? 1e-6 : kTolerance;
  const Vector expected = figures({1, 1, 1});
  for (const Units& u : all_units()) EXPECT_LT((figures(u) - expected).norm(), tolerance * expected.norm()) << u.length;
}

INSTANTIATE_TEST_SUITE_P(Integrators, ScaleOfMotions, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const auto& [name, method] : tested_methods()) names.push_back(name);
                           return names;
                         }()),
                         [](const auto& method) { return method.param; });

}  // namespace
}  // namespace orthodyn::scale_test
