// Natural modes of scenes, compared with closed forms and with a dense solution of the same matrices.
#include "lib/analysis/modes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lib/core/errors.h"
#include "lib/core/symmetric_eigen.h"
#include "tests/fem/built_scene.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::modes_test {
namespace {

Modes modes_of(const BuiltTestScene& s, int count) { return natural_modes(s.model(), {0, s.zero(), s.zero()}, count); }

// Fixed at x = 0, transverse coordinates held, no Poisson's effect: a bar, f1 = sqrt(E/rho)/(4 L).
double relative_error_of_bar(int cells, const char* mass) {
  const BuiltTestScene bar(fmt::format(R"(
mesh: {{type: box, size: [1, 0.05, 0.05], cells: [{}, 1, 1], split: six, order: 1}}
materials:
  spruce: {{type: orthotropic, density: 400, young: [10.8e9, 0.84e9, 0.46e9], nu12: 0, nu23: 0, nu31: 0,
           g12: 0.69e9, g23: 0.032e9, g13: 0.66e9}}
mass: {}
elasticity: {{kinematics: linear}}
clamps:
  - {{surface: x0}}
  - {{box: {{min: [0, 0, 0], max: [1, 0.05, 0.05]}}, components: [y, z]}}
time: {{end: 1}}
)",
                                       cells, mass));
  const double exact = std::sqrt(10.8e9 / 400) / 4;
  return modes_of(bar, 1).modes[0].frequency() / exact - 1;
}

// Errors at 20 cells from an independent program.
TEST(Modes, OfABarConvergeWithTheSquareOfTheElementFromEitherSide) {
  for (const auto& [mass, expected] : {std::pair{"consistent", 2.3e-4}, {"lumped", -2.9e-4}}) {
    const double coarse = relative_error_of_bar(20, mass), fine = relative_error_of_bar(40, mass);
    EXPECT_NEAR(coarse, expected, 0.05e-4) << mass;
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << mass;
  }
}

const char* const kFreeBlock = R"(
mesh: {type: box, size: [2, 1.5, 1], cells: [5, 4, 3], order: 1}
materials:
  wood: {type: orthotropic_stable, density: 500, young: [1e7, 1e6, 5e5], nu: 0.3}
regions: {all: {material: wood, axes: {first: [1, 1, 0], second: [-1, 1, 0]}}}
time: {end: 1}
)";

class FreeBlock : public testing::TestWithParam<const char*> {
 protected:
  BuiltTestScene block_{std::string(kFreeBlock) + "mass: " + GetParam() + "\n"};
};
INSTANTIATE_TEST_SUITE_P(Masses, FreeBlock, testing::Values("lumped", "consistent"));

TEST_P(FreeBlock, HasSixRigidModesAndThenThoseOfTheDenseProblem) {
  const Modes modes = modes_of(block_, 16);
  EXPECT_EQ(modes.zeros, 6);
  const Vector dense = symmetric_eigenvalues(block_.stiffness(block_.zero()), block_.mass());
  for (std::size_t k = 0; k < 16; ++k) {
    const Mode& mode = modes.modes[k];
    if (k < 6) {
      EXPECT_EQ(mode.frequency(), 0);
      continue;
    }
    EXPECT_NEAR(mode.lambda, dense[static_cast<Eigen::Index>(k)], 1e-9 * mode.lambda);
    EXPECT_LT(mode.residual, 1e-7);
  }
}

TEST_P(FreeBlock, HasOrthonormalModesWhoseRigidOnesCarryAllOfItsMass) {
  const Modes modes = modes_of(block_, 12);
  const Eigen::MatrixXd M = block_.mass();
  Vec3 effective = Vec3::Zero();
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j <= i; ++j)
      EXPECT_NEAR(modes.modes[i].shape.dot(M * modes.modes[j].shape), i == j, 1e-9) << i << " " << j;
    if (i < 6) {
      effective += modes.modes[i].effective_mass();
      continue;
    }
    EXPECT_LT(modes.modes[i].effective_mass().maxCoeff(), 1e-9 * 1500);
  }
  for (const double share : effective) EXPECT_NEAR(share, 2 * 1.5 * 1 * 500, 1e-6 * 1500);
}

// Under tension a bending frequency rises, under compression it falls.
TEST(Modes, AboutEquilibriumKnowTheLoads) {
  const BuiltTestScene beam(R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [8, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
time: {end: 1}
)");
  const auto frequency_at = [&](double strain) {
    const Vector q = beam.dofs([&](const Vec3& x) { return Vec3(strain * x[0], 0, 0); });
    return natural_modes(beam.model(), {0, q, beam.zero()}, 1).modes[0].lambda;
  };
  EXPECT_GT(frequency_at(0.01), frequency_at(0));
  EXPECT_LT(frequency_at(-0.01), frequency_at(0));
}

class ModesCommand : public InFolder {};

TEST_F(ModesCommand, WritesATableShapesAndTellsOfRigidModes) {
  write("scene.yaml", kFreeBlock);
  const auto result = orthodyn("modes scene.yaml -n 8 --out out");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("the first 6 are rigid: 0 Hz"), std::string::npos) << result.output;
  EXPECT_NE(read_text(folder_ / "out/modes.csv").find("mode,frequency [Hz],angular_frequency [rad/s]"),
            std::string::npos);
  EXPECT_NE(read_text(folder_ / "out/modes.pvd").find("timestep=\"8\" part=\"0\" file=\"modes/mode_008.vtu\""),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/modes/mode_008.vtu"));
}

TEST_F(ModesCommand, RefusesMoreModesThanUnknownsAndAFreeBodyAboutEquilibrium) {
  write("scene.yaml", kFreeBlock);
  auto result = orthodyn("modes scene.yaml -n 1000 --out out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("1000 modes were requested, but there are 360 unknowns"), std::string::npos)
      << result.output;
  result = orthodyn("modes scene.yaml --equilibrium --out out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("its equilibrium is not unique"), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

// A damped body whose support starts at 3 m/s.
TEST_F(ModesCommand, NeedNoTime) {
  write("bar.yaml",
        "mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 1}\n"
        "materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}\n"
        "clamps: [{surface: x0}]\n");
  for (const char* command : {"modes bar.yaml -n 3 --quiet", "check bar.yaml"}) {
    const auto result = orthodyn(command);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find("notice: the scene has no 'time'"), std::string::npos) << result.output;
  }
  const auto run = orthodyn("run bar.yaml");
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_NE(run.output.find("'time' is missing"), std::string::npos) << run.output;
}

TEST_F(ModesCommand, OfABodyOnAMovingSupportAreThoseOfTheClampedOne) {
  const std::string body = R"(
mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
damping: {stiffness: 0.1, mass: 2}
time: {end: 1}
)";
  write("moved.yaml", body + "motions: [{surface: x0, displacement: [0.3 * sin(10 * t), 0, 0]}]\n");
  write("clamped.yaml", body + "clamps: [{surface: x0}]\n");
  for (const std::string option : {"", "--equilibrium"}) {
    for (const std::string scene : {"moved", "clamped"}) {
      const auto result = orthodyn("modes " + scene + ".yaml -n 24 --force --quiet --out " + scene + " " + option);
      EXPECT_EQ(result.exit_code, 0) << result.output;
    }
    EXPECT_EQ(read_text(folder_ / "moved/modes.csv"), read_text(folder_ / "clamped/modes.csv")) << option;
  }
}

TEST_F(ModesCommand, KeepsEarlierModesUnlessForcedAndForeignFilesAlways) {
  write("scene.yaml", kFreeBlock);
  EXPECT_EQ(orthodyn("modes scene.yaml -n 7 --quiet --out out").exit_code, 0);
  auto result = orthodyn("modes scene.yaml -n 8 --quiet --out out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("use --force to replace them"), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(folder_ / "out/modes/mode_008.vtu"));
  EXPECT_EQ(orthodyn("modes scene.yaml -n 6 --quiet --force --out out").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/modes/mode_007.vtu"));
  result = orthodyn("modes scene.yaml --quiet --force --out .");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("holds files other than modes"), std::string::npos) << result.output;
}

TEST_F(ModesCommand, ThatAreAllRigidHaveNoPictureAndNoWarning) {
  write("scene.yaml", kFreeBlock);
  const auto result = orthodyn("modes scene.yaml -n 3 --out out");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("all 3 modes are rigid; compute more with -n"), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("warning"), std::string::npos) << result.output;
}

TEST_F(ModesCommand, SaysHowManyCanBeAskedFor) {
  write("scene.yaml", kFreeBlock);
  const auto result = orthodyn("modes scene.yaml -n 0 --out out");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_LT(result.output.size(), 200u) << result.output;
}

// A thread so thin that round-off of its axial stiffness hides its bending stiffness.
TEST_F(ModesCommand, OfAClampedThreadAreNotCalledRigid) {
  write("scene.yaml", R"(
mesh: {type: box, size: [1, 1e-8, 1e-8], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
time: {end: 1}
)");
  const auto result = orthodyn("modes scene.yaml -n 8 --out out");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("rigid: 0 Hz"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("cannot be distinguished from zero"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::modes_test
