// Newton iterations per step on shipped scenes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/problems/running.h"

namespace orthodyn::newton_effort_test {
namespace {

struct Shipped {
  const char* name;
  double end;  // s, a part of the motion
};

class NewtonEffort : public testing::TestWithParam<Shipped> {};

// Rotating strips: a matrix is outdated after a few steps. SUNDIALS' default schedule spends three iterations before it
// updates the matrix, and three more with the new one, on both scenes.
constexpr double kIterationsWithOldFirst = 6;

INSTANTIATE_TEST_SUITE_P(Scenes, NewtonEffort, testing::Values(Shipped{"cantilever", 0.25}, Shipped{"twist", 0.6}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(NewtonEffort, OfBdfIsNotSpentOnOldMatrices) {
  const Shipped& shipped = GetParam();
  Config config = Config::from_file(fmt::format(ORTHODYN_SOURCE_DIR "/configs/scenes/{}.yaml", shipped.name));
  config.set_yaml("integrator", "{type: cvode_bdf, rtol: 1e-4}");
  config.set_yaml("mesh.order", "1");
  const BuiltTestScene s(config);
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  const Plan plan{shipped.end, {shipped.end}};
  const Outcome outcome = run(s.model(), *integrator, s.built.initial, plan, {}, {false});
  ASSERT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  const Statistics done = integrator->statistics();
  const auto steps = static_cast<double>(done.steps);
  ASSERT_GT(steps, 50);
  EXPECT_LT(static_cast<double>(done.newton_iterations), kIterationsWithOldFirst * steps);
  // One per attempted step.
  EXPECT_LE(done.tangent.count, done.steps + done.error_test_failures + done.convergence_failures);
}

}  // namespace
}  // namespace orthodyn::newton_effort_test
