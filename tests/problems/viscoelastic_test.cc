// Viscoelastic bodies in motion: all methods against one another, the energy account, and closed forms.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "lib/simulation/harmonic/harmonic_response.h"
#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::viscoelastic_motion_test {
namespace {

// A block that is thrown and turns while it deforms by a few per cent; relaxation is neither slow nor fast.
const std::string kSwelling = "moisture: {formula: '0.3*(1 + x)*sin(2*t)'}";
std::string thrown_block(const std::string& integrator, const std::string& kinematics = "corotational",
                         const std::string& swelling = kSwelling) {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.3, 0.2], cells: [3, 1, 1]}}
materials:
  m:
    type: orthotropic
    density: 1
    young: [10, 4, 2]
    nu12: 0.3
    nu23: 0.3
    nu13: 0.3
    g12: 2
    g23: 1
    g13: 1.5
    expansion: {{moisture: [0.01, 0.1, 0.2]}}
    viscoelastic: [{{time: 0.2, share: 0.3}}, {{time: 2, normal: [0.1, 0.3, 0.2], shear: [0.3, 0.2, 0.1]}}]
elasticity: {{kinematics: {}}}
clamps: [{{surface: x0}}]
initial: {{velocity_field: [0, 0.2*x, -0.1*x]}}
loads: [{{surface: x1, force: [0.002, 0, 0.001], factor: {{type: sine, frequency: 0.4 Hz}}}}]
time: {{end: 2}}
integrator: {{{}}}
{}
)",
                     kinematics, integrator, swelling);
}

struct Motion {
  Outcome outcome;
  EnergyBalance energy;
  double drift = 0;  // of the energy balance, J
};

Motion motion_of(const std::string& yaml) {
  const BuiltTestScene s(yaml);
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  EnergyMeter meter(s.model(), *integrator);
  Motion out{run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&meter}, {false}), {}, 0};
  EXPECT_EQ(out.outcome.status, Outcome::Status::completed) << out.outcome.message;
  out.energy = meter.last();
  out.drift = meter.drift();
  return out;
}

const State& reference() {
  static const State state = motion_of(thrown_block("type: cvode_bdf, rtol: 1e-10, max_order: 5")).outcome.last;
  return state;
}

double error_of(const std::string& integrator) {
  const State state = motion_of(thrown_block(integrator)).outcome.last;
  EXPECT_EQ(state.z.size(), reference().z.size());
  return std::max((state.q - reference().q).norm() / reference().q.norm(),
                  (state.z - reference().z).norm() / reference().z.norm());
}

// Two libraries with different systems of equations.
TEST(Viscoelastic, MethodsWithErrorControlAgree) {
  EXPECT_LE(error_of("type: ida_bdf, rtol: 1e-9, max_order: 5"), 2e-6);
  EXPECT_LE(error_of("type: cvode_bdf, rtol: 1e-6"), 2e-3);
  EXPECT_LE(error_of("type: auto, rtol: 1e-6"), 2e-3);
  EXPECT_LE(error_of("type: arkode_dirk, rtol: 1e-8"), 1e-5);
  EXPECT_LE(error_of("type: arkode_erk, rtol: 1e-8"), 1e-5);
}

struct FixedStep {
  const char* integrator;
  int order;
};
class FixedSteps : public testing::TestWithParam<FixedStep> {};
INSTANTIATE_TEST_SUITE_P(Viscoelastic, FixedSteps,
                         testing::Values(FixedStep{"newmark", 2}, FixedStep{"hht_alpha", 2},
                                         FixedStep{"generalized_alpha", 2}, FixedStep{"bathe", 2},
                                         FixedStep{"tr_bdf2", 2}, FixedStep{"backward_euler", 1},
                                         FixedStep{"semi_implicit_euler", 1}),
                         [](const auto& tested) { return std::string(tested.param.integrator); });

TEST_P(FixedSteps, ConvergeWithTheirOrder) {
  const auto error = [&](double step) {
    return error_of(fmt::format("type: {}, step: {}", GetParam().integrator, step));
  };
  const double step = GetParam().order == 1 ? 5e-4 : 2e-3;  // s
  const double coarse = error(2 * step), fine = error(step);
  EXPECT_NEAR(std::log2(coarse / fine), GetParam().order, 0.25) << coarse << " " << fine;
  EXPECT_LE(fine, GetParam().order == 1 ? 0.025 : 2e-3);
}

TEST(Viscoelastic, EnergyAccountIsClosed) {
  for (const std::string& swelling : {std::string(), kSwelling})
    for (const char* kinematics : {"corotational", "linear"})
      for (const char* integrator : {"type: cvode_bdf, rtol: 1e-8", "type: ida_bdf, rtol: 1e-8",
                                     "type: arkode_dirk, rtol: 1e-8", "type: newmark, step: 5e-4"}) {
        const Motion motion = motion_of(thrown_block(integrator, kinematics, swelling));
        const EnergyBalance& e = motion.energy;
        const double started = 0.5 * 0.06 * (0.2 * 0.2 + 0.1 * 0.1) / 3;  // kinetic energy at the start, J
        EXPECT_GE(e.dissipated, 0.05 * started) << integrator;
        EXPECT_LE(std::abs(motion.drift), 2e-4 * started) << integrator << ", " << kinematics << ", " << swelling;
      }
}

// Steps far longer than vibrations and than relaxation: values within them, and with them the energy account, are
// right.
TEST(Viscoelastic, SlowMotionIsInterpolatedAccurately) {
  constexpr double young = 1e9, share = 0.4, tau = 1e-9, length = 0.1, area = 1e-4, force = 100, period = 7;
  const std::string scene = fmt::format(R"(
mesh: {{type: box, size: [{}, 0.01, 0.01], cells: [4, 1, 1], order: 1}}
materials: {{m: {{type: isotropic, density: 1000, young: {}, nu: 0, viscoelastic: [{{time: {}, share: {}}}]}}}}
clamps: [{{surface: x0}}]
loads: [{{surface: x1, force: [{}, 0, 0], factor: {{type: expression, formula: '(1 - cos(2*pi*t/{}))/2'}}}}]
time: {{end: 14}}
output: {{probes: {{end: {{at: [{}, 0, 0]}}}}}}
integrator: {{type: arkode_dirk, rtol: 1e-4}}
)",
                                        length, young, tau, share, force, period, length);
  const BuiltTestScene s(scene);
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  integrator->start(s.built.initial);
  const double largest = force * length / (young * (1 - share) * area);
  double worst = 0, before = 0;
  int steps = 0;
  while (before < s.scene.time.end) {
    const double t = integrator->step(s.scene.time.end).t;
    for (const double x : {0.25, 0.5, 0.75}) {
      State at;
      const double middle = before + x * (t - before);
      integrator->interpolate(middle, at);
      const double exact = largest * (1 - std::cos(2 * std::numbers::pi * middle / period)) / 2;
      worst = std::max(worst, std::abs(at.q.maxCoeff() - exact));
    }
    before = t;
    ++steps;
  }
  EXPECT_LE(steps, 2000);  // far longer than vibrations, of which there are a million
  EXPECT_LE(worst, 5e-3 * largest);
  EXPECT_LE(std::abs(motion_of(scene).drift), 2e-2 * force * largest / 2);
}

// A closed cycle of strain dissipates pi E'' a^2 with the amplitude a and the loss modulus E''.
TEST(Viscoelastic, DissipatesTheLossModulusInEachCycle) {
  constexpr double young = 1e9, share = 0.4, tau = 0.3, omega = 2 * std::numbers::pi, largest = 1e-3;
  const auto dissipated = [&](int cycles) {
    return motion_of(fmt::format(R"(
mesh: {{type: box, size: [0.1, 0.01, 0.01], cells: [4, 1, 1], order: 1}}
materials: {{m: {{type: isotropic, density: 1000, young: {}, nu: 0, viscoelastic: [{{time: {}, share: {}}}]}}}}
clamps: [{{surface: x0}}]
motions: [{{surface: x1, displacement: ['0.1*{}*(1 - cos({}*t))/2', 0, 0]}}]
time: {{end: {}}}
integrator: {{type: cvode_bdf, rtol: 1e-7}}
)",
                                 young, tau, share, largest, omega, cycles))
        .energy.dissipated;
  };
  const double x = omega * tau, amplitude = largest / 2, volume = 1e-5;
  const double loss_modulus = young * share * x / (1 + x * x);
  const double expected = std::numbers::pi * loss_modulus * amplitude * amplitude * volume;
  EXPECT_NEAR(dissipated(5) - dissipated(4), expected, 1e-3 * expected);
}

// The position scale is the deflection of the body with its stiffness at once if the run is much shorter than the
// relaxation time, and with its relaxed stiffness if the run is much longer.
TEST(Viscoelastic, ScalesAreThoseOfTheStiffnessDuringTheRun) {
  const auto scene = [](const std::string& more, double end) {
    return fmt::format(R"(
mesh: {{type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1]}}
materials: {{m: {{type: isotropic, density: 1, young: 100, nu: 0.3{}}}}}
clamps: [{{surface: x0}}]
loads: [{{surface: x1, force: [0, 0, 1e-6]}}]
time: {{end: {}}}
)",
                       more, end);
  };
  const auto scale = [](const BuiltTestScene& s) { return task_of(s.scene, s.built).scales().position; };
  const std::string relaxing = ", viscoelastic: [{time: 1000, share: 0.9}]";
  const auto ratio = [&](double end) {
    return scale(BuiltTestScene(scene(relaxing, end))) / scale(BuiltTestScene(scene("", end)));
  };
  EXPECT_NEAR(ratio(1), 1, 2e-3);
  EXPECT_NEAR(ratio(1e7), 10, 0.1);
}

// Free swelling moves a body as far at once as after relaxation.
TEST(Viscoelastic, ScalesOfSwellingDoNotDependOnRelaxation) {
  const auto scale = [](const std::string& more, double end) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1]}}
materials: {{m: {{type: isotropic, density: 1, young: 100, nu: 0.3, expansion: {{moisture: 1e-3}}{}}}}}
moisture: {{change: 1}}
clamps: [{{surface: x0}}]
time: {{end: {}}}
)",
                                       more, end));
    return task_of(s.scene, s.built).scales().position;
  };
  const std::string relaxing = ", viscoelastic: [{time: 1000, share: 0.9}]";
  for (const double end : {1.0, 1e3, 1e7}) EXPECT_NEAR(scale(relaxing, end) / scale("", end), 1, 1e-6) << end;
}

TEST(Viscoelastic, NewmarkConvergesWithoutSwelling) {
  const auto z_at = [](const std::string& integrator) {
    return motion_of(thrown_block(integrator, "corotational", "")).outcome.last.z;
  };
  const Vector exact = z_at("type: cvode_bdf, rtol: 1e-9, max_order: 5");
  const double coarse = (z_at("type: newmark, step: 4e-3") - exact).norm(),
               fine = (z_at("type: newmark, step: 2e-3") - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25);
}

TEST(Viscoelastic, CombinationsAreRefusedByName) {
  const auto message = [](const std::string& material, const std::string& more) {
    try {
      const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 1, 1], cells: [1, 1, 1]}}
materials: {{m: {{{}, viscoelastic: [{{time: 1, share: 0.5}}]}}}}
clamps: [{{surface: x0}}]
{}
)",
                                         material, more));
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  const std::string isotropic = "type: isotropic, density: 1, young: 1, nu: 0.3";
  EXPECT_EQ(message(isotropic, "time: {end: 1}"), "accepted");
  EXPECT_THAT(message(isotropic, "regions: {all: {material: m, law: neo_hookean}}\ntime: {end: 1}"),
              testing::HasSubstr("viscoelastic"));
  EXPECT_THAT(message(isotropic,
                      "analysis: harmonic\nloads: [{surface: x1, force: [1, 0, 0], factor: {type: harmonic}}]\n"
                      "harmonic: {frequencies: [1 Hz]}\nsensitivities: [materials.m.young]\n"
                      "output: {probes: {p: {at: [1, 1, 1]}}}"),
              testing::HasSubstr("viscoelastic"));
}

TEST(Viscoelastic, OtherMethodsAreRefusedByName) {
  for (const char* integrator :
       {"type: rosenbrock", "type: exponential_rosenbrock", "type: sdirk", "type: arkode_imex", "type: cvode_adams",
        "type: central_differences", "type: energy_momentum", "type: modal"}) {
    const BuiltTestScene s(thrown_block(integrator));
    try {
      s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
      ADD_FAILURE() << integrator;
    } catch (const ConfigError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("not available with viscoelastic materials")) << integrator;
    }
  }
  const BuiltTestScene s(thrown_block("type: newmark"));
  EXPECT_THROW(s.scene.integrator->make(s.model(), task_of(s.scene, s.built)), ConfigError);
}

using Complex = std::complex<double>;

// A bar without contraction whose modulus is E (1 - 0.3 / (1 + i w t1) - 0.2 / (1 + i w t2)).
TEST(Viscoelastic, HarmonicResponseHasTheComplexModulusOfTheSeries) {
  const double young = 1e9, density = 1000, side = 0.05, t1 = 1e-3, t2 = 5e-5;
  const orthodyn::Setup setup = set_up(Config::from_text(fmt::format(R"(
analysis: harmonic
mesh: {{type: box, size: [1, {0}, {0}], cells: [30, 1, 1], order: 2}}
materials:
  m: {{type: isotropic, density: {1}, young: {2}, nu: 0,
       viscoelastic: [{{time: {3}, share: 0.3}}, {{time: {4}, share: 0.2}}]}}
mass: consistent
clamps: [{{surface: x0}}]
loads: [{{surface: x1, force: [1, 0, 0], factor: {{type: harmonic}}}}]
output: {{probes: {{tip: {{at: [1, 0.025, 0.025], fields: [displacement]}},
                  root: {{at: [0, 0.025, 0.025], fields: [nodal_stress, nodal_strain]}}}}}}
harmonic: {{from: 10, to: 1000, rtol: 1e-6}}
)",
                                                                     side, density, young, t1, t2),
                                                         "scene.yaml"));
  const HarmonicResponse response(setup);
  const auto amplitude = [&](const char* quantity, double frequency) {
    return response.amplitude(find_column(response.columns(), quantity, {}), frequency);
  };
  for (const double frequency : {10.0, 60.0, 160.0, 230.0, 500.0, 750.0, 990.0}) {
    const double omega = 2 * std::numbers::pi * frequency;
    const Complex i(0, 1), modulus = young * (1.0 - 0.3 / (1.0 + i * omega * t1) - 0.2 / (1.0 + i * omega * t2));
    const Complex k = omega * std::sqrt(density / modulus), exact = std::tan(k) / (modulus * side * side * k);
    EXPECT_LE(std::abs(amplitude("tip.displacement.x", frequency) - exact), 3e-4 * std::abs(exact)) << frequency;
    const Complex stress = 1.0 / (side * side * std::cos(k));
    EXPECT_LE(std::abs(amplitude("root.nodal_stress.xx", frequency) - stress), 6e-3 * std::abs(stress)) << frequency;
    const Complex strain = stress / modulus;
    EXPECT_LE(std::abs(amplitude("root.nodal_strain.11", frequency) - strain), 6e-3 * std::abs(strain)) << frequency;
  }
}

}  // namespace
}  // namespace orthodyn::viscoelastic_motion_test
