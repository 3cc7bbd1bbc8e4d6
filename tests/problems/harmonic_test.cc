// Harmonic analyses against closed forms of bars, and against the full complex system.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "lib/simulation/harmonic/harmonic_response.h"
#include "lib/simulation/harmonic/loss_stiffness.h"

namespace orthodyn::harmonic_test {
namespace {

using Complex = std::complex<double>;

struct Analysis {
  explicit Analysis(const std::string& scene)
      : setup(set_up(Config::from_text(scene, "scene.yaml"))), response(setup) {}
  Complex amplitude(const std::string& quantity, double frequency) const {
    return response.amplitude(find_column(response.columns(), quantity, {}), frequency);
  }
  Setup setup;
  HarmonicResponse response;
};

constexpr double kYoung = 1e9, kDensity = 1000, kLength = 1, kSide = 0.05, kLoss = 0.02;

// A bar with nu = 0: it does not contract, so that the equation of a one-dimensional rod is exact.
std::string bar(const std::string& more) {
  return fmt::format(R"(
analysis: harmonic
mesh: {{type: box, size: [{}, {}, {}], cells: [30, 1, 1], order: 2}}
materials: {{m: {{type: isotropic, density: {}, young: {}, nu: 0}}}}
mass: consistent
clamps: [{{surface: x0}}]
output: {{probes: {{tip: {{at: [1, 0.025, 0.025], fields: [displacement, velocity, acceleration]}},
                  root: {{at: [0, 0.025, 0.025], fields: [nodal_stress]}}}}}}
{})",
                     kLength, kSide, kSide, kDensity, kYoung, more);
}

// Complex wave number of a bar whose modulus is E (1 + i eta).
Complex wave_number(double frequency, double loss) {
  return 2 * std::numbers::pi * frequency * std::sqrt(kDensity / (kYoung * Complex(1, loss)));
}

// The natural frequencies are 250 Hz and its odd multiples. At 250 Hz the amplitude is limited by the loss alone.
TEST(Harmonic, BarWithALossyModulusHasTheClosedForm) {
  for (const char* loss : {"factor: 0.02", "quality: 50", "{young: [0.02, 0.02, 0.02], shear: [0.02, 0.02, 0.02]}"}) {
    const Analysis bar_under_force(
        bar(fmt::format("loads: [{{surface: x1, force: [1, 0, 0], factor: {{type: harmonic, phase: 90 deg}}}}]\n"
                        "harmonic: {{from: 50, to: 1000, rtol: 1e-6, losses: {{m: {}}}}}",
                        loss[0] == '{' ? loss : fmt::format("{{{}}}", loss))));
    const Complex phase(0, 1);
    const double at_rest = kLength / (kYoung * kSide * kSide);  // the static displacement, a scale at antiresonances
    for (const double frequency : {60.0, 240.0, 250.0, 253.0, 500.0, 752.0, 990.0}) {
      const Complex k = wave_number(frequency, kLoss), modulus = kYoung * Complex(1, kLoss);
      const Complex exact = phase * std::tan(k * kLength) / (modulus * kSide * kSide * k);
      const Complex rate(0, 2 * std::numbers::pi * frequency);
      const double allowed = 2e-4 * std::abs(exact) + 2e-5 * at_rest;
      EXPECT_LT(std::abs(bar_under_force.amplitude("tip.displacement.x", frequency) - exact), allowed)
          << loss << ", " << frequency << " Hz";
      EXPECT_LT(std::abs(bar_under_force.amplitude("tip.velocity.x", frequency) - rate * exact),
                allowed * std::abs(rate));
      EXPECT_LT(std::abs(bar_under_force.amplitude("tip.acceleration.x", frequency) - rate * rate * exact),
                allowed * std::norm(rate));
    }
  }
}

// The elastic stress at the support; recovered stresses are less accurate than displacements.
TEST(Harmonic, StressAtTheSupportIsThatOfTheClosedForm) {
  const Analysis bar_under_force(
      bar("loads: [{surface: x1, force: [1, 0, 0], factor: {type: harmonic}}]\n"
          "harmonic: {from: 50, to: 1000, rtol: 1e-6, losses: {m: {factor: 0.02}}}"));
  for (const double frequency : {60.0, 250.0, 400.0}) {
    const Complex exact = 1.0 / (kSide * kSide * Complex(1, kLoss) * std::cos(wave_number(frequency, kLoss) * kLength));
    EXPECT_LT(std::abs(bar_under_force.amplitude("root.nodal_stress.xx", frequency) - exact), 5e-3 * std::abs(exact));
  }
}

// The support has an acceleration amplitude of 3 m/s^2. The tip has the absolute amplitude 3 m/s^2 / cos(k L).
TEST(Harmonic, BarOnAVibratingSupportHasTheClosedForm) {
  const Analysis shaken(
      bar("harmonic: {from: 50, to: 1000, rtol: 1e-6, losses: {m: {factor: 0.02}}, base_acceleration: [3, 0, 0]}"));
  for (const double frequency : {60.0, 250.0, 500.0, 755.0}) {
    const Complex exact = 3.0 / std::cos(wave_number(frequency, kLoss) * kLength);
    EXPECT_LT(std::abs(shaken.amplitude("tip.acceleration.x", frequency) - exact), 2e-4 * std::abs(exact));
    const double omega = 2 * std::numbers::pi * frequency;
    EXPECT_LT(std::abs(shaken.amplitude("tip.displacement.x", frequency) + exact / (omega * omega)),
              2e-4 * std::abs(exact) / (omega * omega));
  }
}

// Along material axis 1, an orthotropic bar has the loss factor of E1.
TEST(Harmonic, BarAlongTheGrainHasTheLossFactorOfE1) {
  const Analysis grain(R"(
analysis: harmonic
mesh: {type: box, size: [1, 0.02, 0.02], cells: [20, 1, 1], order: 2}
materials: {m: {type: orthotropic, density: 450, young: [10e9, 1e9, 0.5e9], nu12: 0.4, nu23: 0.4, nu13: 0.4,
                g12: 0.7e9, g23: 0.05e9, g13: 0.6e9}}
clamps: [{surface: x0, components: [x]}, {nearest: [0, 0, 0], components: [y, z]},
         {nearest: [0, 0.02, 0], components: [z]}]
loads: [{surface: x1, force: [1, 0, 0], factor: {type: harmonic}}]
harmonic: {from: 500, to: 1500, losses: {m: {young: [0.007, 0.02, 0.03], shear: [0.02, 0.04, 0.02]}}}
output: {probes: {tip: {at: [1, 0.01, 0.01]}}}
)");
  int found = 0;
  for (std::size_t k = 0; k < grain.response.modes_in_range(); ++k) {
    if (std::abs(grain.response.modes().modes[k].participation[0]) < 0.2) continue;  // bending and torsion
    ++found;
    EXPECT_NEAR(grain.response.resonances()[k].loss_factor, 0.007, 1e-4);  // lateral inertia bends the grain
  }
  EXPECT_EQ(found, 1);
}

// A string under tension, clamped at one end and hinged at the other. Tension stores energy without loss, so that the
// string's loss factor is smaller than the material's, by the factor lambda + (pi lambda)^2. Here lambda is
// (h / L) / sqrt(12 strain). The bending stiffness raises the frequency by the share lambda. Source: Gonzalez &
// Saulson, J. Acoust. Soc. Am. 96, 1994 (2 lambda for two clamped ends).
TEST(Harmonic, TensionOfAStringDilutesTheLoss) {
  const double strain = 1e-3, height = 0.002, lambda = height / std::sqrt(12 * strain);
  const Analysis string(fmt::format(R"(
analysis: harmonic
mesh: {{type: box, size: [1, 0.002, 0.002], cells: [120, 1, 1], elements: hexahedra, order: 2}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e9, nu: 0}}}}
clamps: [{{surface: x0}}, {{surface: x1, components: [y, z]}}]
loads: [{{surface: x1, force: [{}, 0, 0]}}]
terms: [{{type: point_load, nearest: [0.4, 0.001, 0.002], force: [0, 0, 0.001], factor: {{type: harmonic}}}}]
harmonic: {{from: 10, to: 30, losses: {{m: {{factor: 0.05}}}}}}
output: {{probes: {{middle: {{at: [0.5, 0.001, 0.001]}}}}}}
)",
                                    1e9 * strain * height * height));
  EXPECT_TRUE(string.response.is_loaded());
  const auto& first = string.response.resonances().front();
  const double frequency = std::sqrt(1e9 * strain / 1000) / 2;  // of a string without stiffness
  EXPECT_NEAR(first.frequency, frequency * (1 + lambda), 0.003 * frequency);
  const double dilution = lambda + std::pow(std::numbers::pi * lambda, 2);
  EXPECT_NEAR(first.loss_factor / 0.05, dilution, 0.06 * dilution);
}

// Bodies with damping that couples their modes: a plate with dashpots, Rayleigh damping, a damping ratio and unequal
// losses; plies of which one has no loss; rubber in the mixed formulation.
const std::string kPlate = R"(
analysis: harmonic
mesh: {type: box, size: [0.2, 0.1, 0.01], cells: [4, 3, 1], order: 2}
materials: {m: {type: orthotropic, density: 450, young: [10e9, 1e9, 0.5e9], nu12: 0.4, nu23: 0.4, nu13: 0.4,
                g12: 0.7e9, g23: 0.05e9, g13: 0.6e9}}
damping: {mass: 5, stiffness: 2e-6}
terms: [{type: dashpot, nearest: [0.2, 0.1, 0.01], coefficient: 20},
        {type: point_load, nearest: [0.2, 0, 0.01], force: [0, 0, 1], factor: {type: harmonic}},
        {type: point_load, nearest: [0, 0.1, 0.01], force: [0, 1, 2], factor: {type: harmonic, phase: 60 deg}}]
harmonic: {from: 100, to: 2500, damping_ratio: 0.02, rtol: RTOL,
           losses: {m: {young: [0.02, 0.06, 0.08], shear: [0.1, 0.1, 0.1]}}}
output: {probes: {corner: {at: [0.2, 0.1, 0.01]}}}
)";
const std::string kPlies = R"(
analysis: harmonic
mesh: {type: box, size: [0.2, 0.1, 0.01], cells: [4, 3, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}, soft: {type: isotropic, density: 900, young: 1e8,
            nu: 0.4}}
regions: {body: {axes: {first: [1, 0, 0], second: [0, 1, 0]}, layup: [[m, 0, 4 mm], [soft, 0, 2 mm], [m, 0, 4 mm]]}}
terms: [{type: point_load, nearest: [0.2, 0, 0.01], force: [0, 0, 1], factor: {type: harmonic}}]
harmonic: {from: 100, to: 2500, losses: {soft: {factor: 0.5}}, rtol: RTOL}
output: {probes: {corner: {at: [0.2, 0.1, 0.01]}}}
)";
const std::string kRubber = R"(
analysis: harmonic
mesh: {type: box, size: [0.2, 0.1, 0.1], cells: [2, 1, 1], elements: hexahedra_27, parts: {end: {min: [0.1, 0, 0],
       max: [0.2, 0.1, 0.1]}}}
materials: {m: {type: isotropic, density: 1000, young: 1e7, nu: 0.4999}, rest: {type: isotropic, density: 1000, young: 1e7,
            nu: 0.3}}
regions: {body: {material: m}, end: {material: rest}}
terms: [{type: point_load, nearest: [0.2, 0, 0.1], force: [0, 0, 1], factor: {type: harmonic}}]
harmonic: {from: 10, to: 700, losses: {m: {factor: 0.3}, rest: {factor: 0.01}}, rtol: RTOL}
output: {probes: {corner: {at: [0.2, 0.1, 0.1]}}}
)";
const std::string kClamp = "clamps: [{surface: x0}]\n";

std::string with_rtol(std::string scene, double rtol) {
  return scene.replace(scene.find("RTOL"), 4, fmt::format("{}", rtol));
}

// The full complex system, solved densely.
Eigen::VectorXcd full_solution(const Analysis& plate, double frequency) {
  const FemModel& model = *plate.setup.built.model;
  const Vector zero = Vector::Zero(model.num_dofs());
  const auto& pattern = model.pattern();
  Linearization at;
  model.linearize(kSteadyPart, zero, zero, TangentKind::exact, at);
  const auto dense = [&](const std::vector<double>& values) {
    const Eigen::MatrixXd lower(pattern.matrix(values.data()));
    return Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>());
  };
  const auto matrix = [&](const Weights& weights) {
    std::vector<double> values(pattern.row.size());
    model.combine(weights, at, values.data());
    return dense(values);
  };
  const double omega = 2 * std::numbers::pi * frequency;
  Eigen::MatrixXcd A(zero.size(), zero.size());
  A.real() = matrix({-omega * omega, 0, 1});
  A.imag() = matrix({0, omega, 0});
  if (const auto loss = loss_stiffness(plate.setup.scene, model, zero); !loss.empty()) A.imag() += dense(loss);
  const double ratio = plate.setup.scene.harmonic->damping_ratio;
  const Eigen::MatrixXd mass = matrix({1, 0, 0});
  for (const Mode& mode : plate.response.modes().modes) {
    const Vector momentum = mass * mode.shape;
    A.imag() += omega * 2 * ratio * mode.angular_frequency() * momentum * momentum.transpose();
  }
  Eigen::VectorXcd load(zero.size());
  Vector part(zero.size());
  model.force(kRealPart, zero, zero, part);
  load.real() = part;
  model.force(kImaginaryPart, zero, zero, part);
  load.imag() = part;
  return A.partialPivLu().solve(load);
}

// The largest relative error of the probe's displacement, at frequencies of the range and at resonances. This error may
// exceed the error in the energy norm, which rtol limits.
double largest_error(const Analysis& plate) {
  const FemModel& model = *plate.setup.built.model;
  const Harmonic& harmonic = *plate.setup.scene.harmonic;
  std::vector<double> frequencies{harmonic.lowest(), 0.3 * harmonic.highest(), 0.71 * harmonic.highest()};
  for (const auto& [frequency, loss_factor] : plate.response.resonances())
    if (frequency > harmonic.lowest() && frequency < harmonic.highest() && frequencies.size() < 7)
      frequencies.push_back(frequency);
  const int node = nearest_node(model.parts().mesh, plate.setup.scene.output.probes[0].second.at);
  double largest = 0;
  for (const double frequency : frequencies) {
    const Eigen::VectorXcd exact = full_solution(plate, frequency);
    const auto u = [&](const Vector& q) {
      const State state{0, q, Vector::Zero(q.size())};
      const auto at = ObservedState(model, state).evaluate_at("displacement", node, 3);
      return Vec3(at[0], at[1], at[2]);
    };
    const Vec3 real = u(exact.real()), imaginary = u(exact.imag());
    double difference = 0, size = 0;
    for (int c = 0; c < 3; ++c) {
      const Complex wanted(real[c], imaginary[c]);
      difference += std::norm(plate.amplitude(std::string("corner.displacement.") + "xyz"[c], frequency) - wanted);
      size += std::norm(wanted);
    }
    largest = std::max(largest, std::sqrt(difference / size));
  }
  return largest;
}

TEST(Harmonic, ReducedSystemConvergesToTheFullOne) {
  for (const std::string& scene : {kPlate + kClamp, kPlate, kPlies + kClamp, kRubber + kClamp, kRubber})
    for (const double rtol : {1e-2, 1e-4, 1e-6}) {
      const Analysis body(with_rtol(scene, rtol));
      EXPECT_LE(body.response.error(), rtol) << scene;
      EXPECT_LT(largest_error(body), 10 * rtol) << scene << ", rtol " << rtol;
    }
}

// Far below its natural frequencies a free body moves like a rigid one.
TEST(Harmonic, FreeBodyAcceleratesByForceOverMass) {
  const Analysis body(
      "analysis: harmonic\nmesh: {type: box, size: [0.2, 0.1, 0.1], cells: [4, 2, 2], order: 2}\n"
      "materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}\n"
      "loads: [{surface: x1, force: [3, 0, 0], factor: {type: harmonic}}]\n"
      "harmonic: {from: 1, to: 100, damping_ratio: 0.01}\n"
      "output: {probes: {middle: {at: [0.1, 0.05, 0.05], fields: [acceleration, nodal_stress]}}}\n");
  EXPECT_LT(std::abs(body.amplitude("middle.acceleration.x", 10) - 3.0 / (1000 * 0.002)), 1e-4);
  // Half of the body is behind the middle: its inertia takes half of the force.
  EXPECT_NEAR(std::abs(body.amplitude("middle.nodal_stress.xx", 10)), 1.5 / 0.01, 0.01 * 150);
}

// Two bending modes of a square bar have the same frequency. A dashpot that resists all motion of the tip damps both
// alike, whichever combinations the eigenvalue solver finds.
TEST(Harmonic, RepeatedModesHaveTheLossFactorsOfTheDampedModes) {
  const std::string bar = R"(
analysis: harmonic
mesh: {type: box, size: [1, 0.05, 0.05], cells: [12, 2, 2], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
terms: [{type: dashpot, nearest: [1, 0.025, 0.025], coefficient: 0.1},
        {type: point_load, nearest: [1, 0.05, 0.025], force: [0, 1, 1], factor: {type: harmonic}}]
harmonic: {from: 5, to: 15}
output: {probes: {tip: {at: [1, 0.05, 0.025]}}}
)";
  const Analysis both(bar);
  ASSERT_GE(both.response.modes_in_range(), 2u);
  const auto& resonances = both.response.resonances();
  EXPECT_NEAR(resonances[0].loss_factor / resonances[1].loss_factor, 1, 1e-6);
  // The mode of a cantilever of mass m has the square 4 / m at its tip: eta = c (4 / m) / omega.
  const double expected = 0.1 * 4 / (1000 * 0.0025) / (2 * std::numbers::pi * resonances[0].frequency);
  EXPECT_NEAR(resonances[0].loss_factor, expected, 0.02 * expected);
}

TEST(Harmonic, DampingRatioIsThatOfEachMode) {
  const Analysis plate(R"(
analysis: harmonic
mesh: {type: box, size: [0.2, 0.1, 0.01], cells: [4, 3, 1], order: 2}
materials: {m: {type: isotropic, density: 450, young: 10e9, nu: 0.3}}
damping: {mass: 10}
terms: [{type: point_load, nearest: [0.2, 0, 0.01], force: [0, 0, 1], factor: {type: harmonic}}]
harmonic: {from: 10, to: 3000, damping_ratio: 0.015}
output: {probes: {corner: {at: [0.2, 0.1, 0.01]}}}
)");
  std::size_t elastic = 0;
  for (const auto& [frequency, loss_factor] : plate.response.resonances()) {
    if (frequency == 0) continue;
    ++elastic;
    EXPECT_NEAR(loss_factor, 2 * 0.015 + 10 / (2 * std::numbers::pi * frequency), 1e-9);
  }
  EXPECT_GE(elastic, 3u);
}

}  // namespace
}  // namespace orthodyn::harmonic_test
