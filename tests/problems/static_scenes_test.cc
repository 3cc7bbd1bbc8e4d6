// Static scenes and starts from equilibrium, against closed forms and independent programs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "lib/analysis/modes.h"
#include "lib/analysis/rigid_freedom.h"
#include "lib/simulation/statics/load_steps.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/problems/running.h"

namespace orthodyn::static_scenes_test {
namespace {

std::string error_of(const std::string& yaml) {
  try {
    const BuiltTestScene s(yaml);
    static_problem(s.scene, s.built);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "accepted";
}

// With zero Poisson ratios the corotational law of a bar in uniform tension is linear: u = t x/E.
TEST(StaticScene, ABarUnderTractionStretchesAsInTheClosedForm) {
  const BuiltTestScene bar(R"(
analysis: static
mesh: {type: box, size: [1, 0.2, 0.1], cells: [4, 2, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, traction: [1e5, 0, 0]}]
)");
  const NodalVector u = bar.nodal(equilibrium(bar.scene, bar.built));
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vec3 x = bar.model().parts().rest->col(i);
    EXPECT_LT((u.col(i) - Vec3(0.1 * x[0], 0, 0)).norm(), 1e-8);
  }
}

// A block on soft springs, which a step of the load would push through the body below it. A surface of one cell below a
// finer one has no nodes in the contact: the stiffness is half of the given one.
TEST(StaticScene, DoesNotPushABlockThroughABody) {
  for (const char* law : {"contact, stiffness: 1e9, onset: 1e-7", "barrier_contact, stiffness: 1e10, gap: 1e-4"}) {
    const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    low: {mesh: {type: box, size: [0.3, 0.3, 0.05], cells: [1, 1, 1], elements: hexahedra, order: 1, origin: [-0.15, -0.15, -0.0501]}}
    up: {mesh: {type: box, size: [0.1, 0.1, 0.05], cells: [4, 4, 1], elements: hexahedra, order: 1, origin: [-0.05, -0.05, 0]}}
materials: {m: {type: isotropic, density: 500, young: 1e8, nu: 0}}
clamps: [{region: low}, {surface: up.z1, components: [x, y]}]
loads: [{surface: up.z1, traction: [0, 0, -1e4]}]
terms: [{type: spring, surface: up.z1, stiffness: 1e3}, {between: [low.z1, up.z0], type: )" +
                           std::string(law) + R"(}]
analysis: static
)");
    const NodalVector u = s.nodal(equilibrium(s.scene, s.built));
    double bottom = 0;
    for (Eigen::Index i = 0; i < u.cols(); ++i)
      if (s.model().parts().rest->col(i)[2] == 0) bottom += u(2, i) / 25;
    if (law[0] == 'c') {
      EXPECT_NEAR(bottom, -1e-4 - 1e4 / 0.5e9, 5e-6) << law;
    } else {
      EXPECT_LT(bottom, 0) << law;
      EXPECT_GT(bottom, -1e-4) << law;
    }
  }
}

TEST(StaticScene, TakesFactorsOfLoadsAtTheEndOfItsTime) {
  const std::string bar = R"(
analysis: static
mesh: {type: box, size: [1, 0.2, 0.1], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, traction: [1e5, 0, 0], factor: {type: ramp, end: 4}}]
)";
  for (const double end : {1.0, 2.0}) {
    const BuiltTestScene s(bar + fmt::format("time: {{end: {}}}\n", end));
    EXPECT_NEAR(equilibrium(s.scene, s.built).maxCoeff(), 0.1 * end / 4, 1e-8);
  }
  EXPECT_NE(error_of(bar).find("varies in time"), std::string::npos);
}

const std::string kBlock = R"(analysis: static
mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
gravity: [0, 0, -1]
)";

TEST(StaticScene, RefusesABodyThatCanMoveFreelyAndSaysHow) {
  const std::pair<const char*, std::vector<const char*>> cases[] = {
      {"", {"translated along x, y, z", "rotated about x, y, z", "Clamp it"}},
      {"clamps: [{nearest: [0, 0, 0]}]", {"the body can move in 3 combined ways", "clamps.0"}},
      {"clamps: [{surface: x0, components: [x]}]", {"translated along y, z", "rotated about x"}},
      {"clamps: [{surface: x0, components: [y, z]}]", {"can be translated along x"}},
  };
  for (const auto& [clamps, parts] : cases)
    for (const char* part : parts) {
      const std::string message = error_of(kBlock + clamps + "\n");
      EXPECT_NE(message.find(part), std::string::npos) << part << "\nin: " << message;
    }
  EXPECT_EQ(error_of(kBlock + "clamps: [{nearest: [0, 0, 0]}, {nearest: [2, 0, 0]}, {nearest: [0, 1, 0]}]\n"),
            "accepted");
}

TEST(StaticScene, RefusesWhatBelongsToMotion) {
  for (const auto& [key, says] : {std::pair{"integrator: {type: ida_bdf}", "only with analysis: dynamic"},
                                  {"initial: {velocity: [1, 0, 0]}", "only with analysis: dynamic"},
                                  {"checkpoint: {}", "only with analysis: dynamic"},
                                  {"start: equilibrium", "only with analysis: dynamic"},
                                  {"output: {frames: 3}", "a frame for each load step"},
                                  {"output: {momentum: true}", "momentum"}}) {
    const std::string message = error_of(kBlock + "clamps: [{surface: x0}]\n" + key + "\n");
    EXPECT_NE(message.find(says), std::string::npos) << key << "\nin: " << message;
  }
}

TEST(StaticScene, OfItsOwnDefaultsIsAccepted) {
  const Config config = Config::from_text(kBlock + "clamps: [{surface: x0}]\n").resolving();
  read_scene(config);
  read_scene(Config::from_text(config.dump()));
}

TEST(StaticScene, ThatCannotGoOnEndsWithItsLastEquilibrium) {
  const BuiltTestScene block(R"(
analysis: static
statics: {max_steps: 2}
mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 2], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: z0}]
loads: [{surface: z1, traction: [0, 0, 1e4]}]
)");
  const StaticProblem problem = static_problem(block.scene, block.built);
  std::vector<double> seen;
  Watch watch([&](const State& state) { seen.push_back(state.t); });
  const Outcome outcome = run_static(*problem.path, *problem.stepper, {&watch}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::failed);
  EXPECT_EQ(outcome.reason, Reason::too_many_steps);
  EXPECT_EQ(outcome.last.t, 0.75);
  EXPECT_EQ(seen, (std::vector<double>{0, 0.25, 0.75}));
}

TEST(EquilibriumStart, StaysWhereItIs) {
  const char* const text = R"(
start: equilibrium
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
time: {end: 1}
)";
  const auto setup = set_up(Config::from_text(text));
  const auto& model = *setup.built.model;
  const double sag = setup.built.initial.q.lpNorm<Eigen::Infinity>();
  EXPECT_GT(sag, 0.02);
  Vector f(model.num_dofs());
  model.force(0, setup.built.initial.q, setup.built.initial.v, f);
  EXPECT_LT(f.lpNorm<Eigen::Infinity>(), 1e-6);
  const Outcome outcome = run(model, *setup.integrator, setup.built.initial, {1, {}, false}, {}, {false});
  EXPECT_LT((outcome.last.q - setup.built.initial.q).lpNorm<Eigen::Infinity>(), 1e-4 * sag);
}

TEST(EquilibriumStart, AddsTheInitialVelocityAboutTheDeformedShape) {
  const BuiltTestScene s(R"(
start: equilibrium
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
initial: {spin: [0, 2, 0], center: [0, 0, 0]}
time: {end: 1}
)");
  const auto setup = set_up(Config::from_text(R"(
start: equilibrium
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
initial: {spin: [0, 2, 0], center: [0, 0, 0]}
time: {end: 1}
)"));
  const NodalVector x = s.positions(setup.built.initial.q), v = s.nodal(setup.built.initial.v);
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    if (x(0, i) > 1e-6) {
      EXPECT_LT((v.col(i) - Vec3(0, 2, 0).cross(Vec3(x.col(i)))).norm(), 1e-12);
    }
}

TEST(EquilibriumStart, IsRefusedTogetherWithAnInitialDeformation) {
  const std::string message = error_of(R"(start: equilibrium
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
clamps: [{surface: x0}]
initial: {noise: {amplitude: 1e-3}}
time: {end: 1}
)");
  EXPECT_NE(message.find("initial: start: equilibrium determines the shape"), std::string::npos) << message;
}

class StaticReference : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("ORTHODYN_DATA");
    if (!data) GTEST_SKIP() << "ORTHODYN_DATA is not set: no reference data";
    folder_ = std::string(data) + "/reference/";
  }

  // All columns but the first, below the header.
  std::vector<std::vector<double>> rows(const std::string& file) const {
    std::ifstream in(folder_ + file);
    std::string line;
    std::getline(in, line);
    std::vector<std::vector<double>> out;
    while (std::getline(in, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream row(line);
      double first = 0, value = 0;
      row >> first;
      out.emplace_back();
      while (row >> value) out.back().push_back(value);
    }
    return out;
  }

  std::string folder_;
};

// Mesh, material and load from case.json of C06a: a strip bent by 64 degrees.
TEST_F(StaticReference, AStripBendsFarAsInAnIndependentCorotationalProgram) {
  const BuiltTestScene strip(fmt::format(R"(
analysis: static
mesh: {{type: gmsh, file: {}meshes/strip.v22.msh}}
materials: {{solid: {{type: isotropic, density: 1000, young: 1e9, nu: 0}}}}
clamps: [{{surface: fixed}}]
loads: [{{surface: load, traction: [0, 0, 1e5]}}]
)",
                                         folder_));
  const NodalVector u = strip.nodal(equilibrium(strip.scene, strip.built));
  for (const auto& [file, tolerance] : {std::pair{"corot", 1e-6}, {"getfem_stvk", 3.741e-4}, {"ccx", 3.741e-4}}) {
    const auto expected = rows(std::string("C06a_bend_iso/") + file + ".csv");
    ASSERT_EQ(static_cast<Eigen::Index>(expected.size()), u.cols()) << file;
    double largest = 0, difference = 0;
    for (Eigen::Index i = 0; i < u.cols(); ++i) {
      const Eigen::Map<const Vec3> reference(expected[static_cast<std::size_t>(i)].data());
      largest = std::max(largest, reference.cwiseAbs().maxCoeff());
      difference = std::max(difference, (u.col(i) - reference).cwiseAbs().maxCoeff());
    }
    EXPECT_LT(difference, tolerance * largest) << file;
  }
}

// From case.json of C02: an off-axis orthotropic cantilever.
TEST_F(StaticReference, ACantileverHasTheFrequenciesOfAnIndependentProgram) {
  for (const char* mass : {"consistent", "lumped"}) {
    const BuiltTestScene beam(fmt::format(R"(
mesh: {{type: gmsh, file: {}meshes/beam.v22.msh}}
materials:
  solid: {{type: orthotropic, density: 420, young: [11e9, 0.9e9, 0.5e9], nu12: 0.37, nu13: 0.42, nu23: 0.47,
          g12: 0.75e9, g13: 0.72e9, g23: 0.039e9}}
regions:
  solid:
    material: solid
    axes:
      first: [0.9274777915203365, 0.32461722703211776, 0.1854955583040673]
      second: [-0.37051096500769853, 0.8644610922477269, 0.3397479136049706]
mass: {}
clamps: [{{surface: fixed}}]
time: {{end: 1}}
)",
                                          folder_, mass));
    const auto expected = rows(std::string("C02_ortho_freq/") + mass + ".csv");
    const Modes modes = natural_modes(beam.model(), {0, beam.zero(), beam.zero()}, 10);
    EXPECT_EQ(modes.zeros, 0);
    ASSERT_EQ(expected.size(), 10u);
    for (std::size_t k = 0; k < 10; ++k)
      EXPECT_NEAR(modes.modes[k].frequency(), expected[k][0], 1e-7 * expected[k][0]) << mass << " " << k;
  }
}

}  // namespace
}  // namespace orthodyn::static_scenes_test
