// Motions computed by several MPI ranks. With a fixed step they equal those of one rank to round-off; with error
// control they agree within the tolerance. Some are compared with exact solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/linear/mpi_world.h"
#include "lib/simulation/run/setup.h"
#include "tests/ranks/scenes.h"

namespace orthodyn {
namespace {

struct Motion {
  State end;
  long steps = 0;
};

// Integrates to the end time. Motion::end has the unknowns of all ranks.
Motion integrate(const std::string& yaml, const Ranks* ranks, double rtol_of_time = 1e-12) {
  orthodyn::Setup setup = set_up(Config::from_text(yaml, "scene.yaml"), false, true, ranks);
  const double end = setup.scene.time.end;
  setup.integrator->start(setup.built.initial);
  State state;
  double t = setup.built.initial.t;
  while (t < end * (1 - rtol_of_time)) t = setup.integrator->step(end).t;
  setup.integrator->interpolate(t, state);
  return {setup.built.model->whole(state), setup.integrator->statistics().steps};
}

double difference(const Vector& found, const Vector& expected) {
  return (found - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

std::string integrator(const std::string& keys) {
  return "integrator: {position_scale: 0.1, velocity_scale: 1, " + keys + "}\n";
}

class SharedMotion : public testing::TestWithParam<SharedScene> {};

TEST_P(SharedMotion, OfFixedStepIsTheSameToRoundOff) {
  for (const char* method :
       {"type: generalized_alpha, step: 0.005, rtol: 1.0e-11, max_newton_iterations: 30, linear_solver: petsc",
        "type: tr_bdf2, step: 0.005, rtol: 1.0e-11, max_newton_iterations: 30, linear_solver: petsc",
        "type: central_differences, step: 1.0e-5"}) {
    const std::string scene = GetParam().yaml + (std::string(method).find("central") == std::string::npos
                                                     ? integrator(method)
                                                     : std::string("integrator: {") + method + "}\n");
    const std::string span = std::string(method).find("central") == std::string::npos ? "0.05" : "0.002";
    Config config = Config::from_text(scene, "scene.yaml");
    config.set("time.end", std::stod(span));
    const std::string yaml = config.dump();
    const Motion one = integrate(yaml, nullptr), shared = integrate(yaml, mpi_world());
    EXPECT_EQ(shared.steps, one.steps) << method;
    EXPECT_LE(difference(shared.end.q, one.end.q), 1e-10) << method;
    EXPECT_LE(difference(shared.end.v, one.end.v), 1e-9) << method;
  }
}

TEST_P(SharedMotion, WithErrorControlIsTheSameWithinTheTolerance) {
  for (const char* method :
       {"type: cvode_bdf, rtol: 1.0e-5, linear_solver: petsc", "type: ida_bdf, rtol: 1.0e-5, linear_solver: petsc",
        "type: arkode_dirk, rtol: 1.0e-5, linear_solver: petsc"}) {
    const std::string yaml = GetParam().yaml + integrator(method);
    const Motion one = integrate(yaml, nullptr), shared = integrate(yaml, mpi_world());
    // The position scale is 0.1 m, and the errors of some hundred steps accumulate in both runs.
    EXPECT_LE((shared.end.q - one.end.q).lpNorm<Eigen::Infinity>(), 3e-4) << method;
  }
}

// Each method that runs on ranks, for a body of usual size and for one so small that some of seven ranks have no part
// of it. Because the linear solver is the same and norms include all ranks, the steps must be the same.
class SharedMethod : public testing::TestWithParam<std::string> {};

TEST_P(SharedMethod, TakesTheStepsThatItTakesOnOneRank) {
  const auto choice = Registry<IntegratorChoice>::entries().at(GetParam()).make();
  std::string keys = "{type: " + GetParam() + (choice->settings().rtol ? ", rtol: 1.0e-5" : ", step: 1.0e-5");
  if (GetParam() == "arkode_imex") keys += ", explicit: [gravity]";
  if (choice->settings().linear_solver) keys += ", linear_solver: cholesky";
  for (const SharedScene& scene : shared_scenes()) {
    if (scene.name != "clamped" && scene.name != "small") continue;
    SCOPED_TRACE(scene.name);
    Config config = Config::from_text(scene.yaml + "integrator: " + keys + "}\n", "scene.yaml");
    config.set("time.end", 0.005);
    const Motion one = integrate(config.dump(), nullptr), shared = integrate(config.dump(), mpi_world());
    EXPECT_LE(std::abs(shared.steps - one.steps), 1) << "of " << one.steps;
    EXPECT_LE(difference(shared.end.q, one.end.q), 1e-4);
  }
}

// Butcher tables of ARKODE with a later stage at the start of the step.
TEST(SharedTables, KnowTheStepsEndOnAllRanks) {
  for (const char* method : {"arkode_erk, table: FEHLBERG_13_7_8", "arkode_dirk, table: SDIRK_2_1_2"}) {
    SCOPED_TRACE(method);
    const std::string yaml = shared_scenes().back().yaml + "integrator: {type: " + method + ", rtol: 1.0e-5}\n";
    Config config = Config::from_text(yaml, "scene.yaml");
    config.set("time.end", 0.005);
    const Motion one = integrate(config.dump(), nullptr), shared = integrate(config.dump(), mpi_world());
    EXPECT_LE(difference(shared.end.q, one.end.q), 1e-4);
  }
}

std::vector<std::string> methods_on_ranks() {
  std::vector<std::string> names;
  for (const auto& [name, entry] : Registry<IntegratorChoice>::entries())
    if (entry.make()->runs_on_ranks()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Methods, SharedMethod, testing::ValuesIn(methods_on_ranks()),
                         [](const auto& method) { return method.param; });

// The scenes whose motions differ in kind. model_test.cc covers all scenes.
std::vector<SharedScene> moving_scenes() {
  std::vector<SharedScene> some;
  for (const SharedScene& scene : shared_scenes())
    if (scene.name != "quadratic" && scene.name != "turned") some.push_back(scene);
  return some;
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedMotion, testing::ValuesIn(moving_scenes()),
                         [](const auto& scene) { return scene.param.name; });

// A free body flies and turns slowly. Its centre must move on a parabola for any partition.
TEST(SharedFlight, OfTheCentreIsAParabola) {
  const std::string yaml = R"(
mesh: {type: box, size: [1, 0.2, 0.1], cells: [8, 2, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
initial: {velocity: [1, 0, 3], spin: [0, 0.5, 0]}
gravity: [0, 0, -9.81]
time: {end: 0.3}
)" + integrator("type: cvode_bdf, rtol: 1.0e-6");
  orthodyn::Setup setup = set_up(Config::from_text(yaml, "scene.yaml"), false, true, mpi_world());
  const FemModel& model = *setup.built.model;
  setup.integrator->start(setup.built.initial);
  double t = 0;
  while (t < 0.3) t = setup.integrator->step(0.3).t;
  State end;
  setup.integrator->interpolate(t, end);
  const double mass = model.parts().mass->total();
  const auto momentum = model.evaluate("momentum.linear", end);
  EXPECT_NEAR(momentum[0] / mass, 1, 1e-6);
  EXPECT_NEAR(momentum[1] / mass, 0, 1e-6);
  EXPECT_NEAR(momentum[2] / mass, 3 - 9.81 * 0.3, 1e-5);
}

// A stiff free box turns about a principal axis. After half a turn each node is opposite to its initial position, up to
// the centrifugal strain rho (omega L)^2 / E = 1e-6. The angular momentum is conserved.
TEST(SharedFlight, OfASpinningBoxIsARotation) {
  const std::string yaml = R"(
mesh: {type: box, size: [1, 0.2, 0.1], origin: [-0.5, -0.1, -0.05], cells: [8, 2, 1], order: 1}
materials: {hard: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
initial: {spin: [0, 0, 1]}
time: {end: 3.141592653589793}
)" + integrator("type: cvode_bdf, rtol: 1.0e-6, max_order: 2");
  const Motion motion = integrate(yaml, mpi_world());
  const orthodyn::Setup whole = set_up(Config::from_text(yaml, "scene.yaml"));
  const FemModel& model = *whole.built.model;
  const Eigen::Map<const Vector> x(model.parts().rest->data(), model.num_dofs());
  for (Eigen::Index k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k] + motion.end.q[k], k % 3 == 2 ? x[k] : -x[k], 4e-3) << k;
  const double before = model.evaluate("momentum.angular", whole.built.initial)[2];
  EXPECT_NEAR(model.evaluate("momentum.angular", motion.end)[2], before, 1e-3 * before);
}

// A longitudinal wave runs along a bar across all borders between ranks. With nu = 0 the first frequency of the bar is
// c / (4 L), with the wave speed c and length L. The error due to the mesh is of second order in its size.
TEST(SharedWave, OfABarHasItsFrequency) {
  const int cells = 20;
  const std::string yaml = "mesh: {type: box, size: [1, 0.05, 0.05], cells: [" + std::to_string(cells) +
                           R"(, 1, 1], order: 1}
materials: {bar: {type: isotropic, density: 1000, young: 1e5, nu: 0.0}}
clamps: [{surface: x0}]
initial: {displacement_field: ["sin(pi * x / 2) / 1000", "0", "0"]}
elasticity: {kinematics: linear}
time: {end: 0.4}
)" + integrator("type: generalized_alpha, step: 0.001, rho_inf: 1, rtol: 1.0e-10");
  const Motion motion = integrate(yaml, mpi_world());
  // After one period, T = 4 L / c = 0.4 s, the bar is in its initial state.
  orthodyn::Setup setup = set_up(Config::from_text(yaml, "scene.yaml"), false, true, nullptr);
  const Vector& start = setup.built.initial.q;
  EXPECT_LE((motion.end.q - start).lpNorm<Eigen::Infinity>(), 1e-2 * start.lpNorm<Eigen::Infinity>());
}

}  // namespace
}  // namespace orthodyn
