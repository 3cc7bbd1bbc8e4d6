// A state view shares intermediate results; each output is the same as computed alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/fem/fem_state_view.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::state_view_test {
namespace {

class Views : public testing::TestWithParam<std::string> {
 protected:
  Views()
      : scene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.5], cells: [3, 2, 2], order: 1}}
materials: {{m: {}}}
mass: {}
clamps: [{{surface: x0, components: [x, y]}}]
motions: [{{surface: x1, rotation: {{point: [1, 0.5, 0], axis: [1, 2, 2], angle: 0.3 rad}}, factor: {{type: smooth_step, end: 2}}}}]
damping: {{mass: 0.2, stiffness: 0.05}}
gravity: [0, 0, -9.81]
output: {{reactions: true}}
time: {{end: 1}}
)",
                          fibre_material(10), GetParam())) {
    state = {0.3, random_dofs(random, scene.size(), 0.05), random_dofs(random, scene.size(), 1)};
  }

  Random random{311};
  BuiltTestScene scene;
  State state;
};
INSTANTIATE_TEST_SUITE_P(Masses, Views, testing::Values("lumped", "consistent"));

// Compares values; NaN, which stands for no value, equals NaN.
bool are_same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

TEST_P(Views, GiveEachOutputInAnyOrderAsItIsAlone) {
  const auto& model = scene.model();
  auto outputs = model.outputs();
  for (int pass = 0; pass < 2; ++pass) {
    const auto view = model.view(state);
    for (const auto& output : outputs)
      EXPECT_TRUE(are_same(view->evaluate(output.name), model.evaluate(output.name, state))) << output.name;
    std::reverse(outputs.begin(), outputs.end());
  }
}

TEST_P(Views, DoNotSeeWhatTheStateBecomesAfterwards) {
  const auto view = scene.model().view(state);
  const auto before = scene.model().evaluate("energy.kinetic", state);
  state.v *= 2;
  EXPECT_EQ(view->evaluate("energy.kinetic"), before);
}

int looks = 0;

// Von Mises stress, principal stresses and exposures derive from the same tensor.
TEST_P(Views, ATensorIsRecoveredOnceForAllThatIsMadeOfIt) {
  const FemStateView view(scene.model().parts(), state);
  const TensorField counted{"counted", "1", "", {}, [](const PointObservation& o) {
                              ++looks;
                              return o.strain;
                            }};
  looks = 0;
  const auto& first = view.recovered().of(counted, 0);
  const int once = looks;
  EXPECT_GT(once, 0);
  EXPECT_EQ(&view.recovered().of(counted, 0), &first);
  EXPECT_EQ(tensor_at_nodes(view.recovered(), counted, {0}).size(), 6 * scene.mesh().nodes.size());
  EXPECT_EQ(looks, once);
  EXPECT_EQ(&view.mesh_errors(), &view.mesh_errors());
}

// At a node inside of a region, at one between regions and at edge midpoints, alone and after the whole field.
TEST(StateView, GivesANodeAsTheWholeFieldDoes) {
  Random random{17};
  for (const int order : {1, 2}) {
    const BuiltTestScene scene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.5], cells: [4, 2, 1], order: {}, parts: {{left: {{min: [0, 0, 0], max: [1, 1, 1]}}}}}}
materials: {{m: {}}}
regions: {{left: {{material: m}}, body: {{material: m, axes: {}}}}}
clamps: [{{surface: x0}}]
time: {{end: 1}}
)",
                                           order, fibre_material(10), kTurnedAxes));
    const State state{0, random_dofs(random, scene.size(), 0.02), random_dofs(random, scene.size(), 1)};
    const auto nodes = static_cast<int>(scene.mesh().nodes.size());
    for (const OutputInfo& output : scene.model().outputs()) {
      if (output.location != Location::node) continue;
      const auto all = scene.model().evaluate(output.name, state);
      const auto largest = std::accumulate(all.begin(), all.end(), 0.0, [](double most, double value) {
        return std::isfinite(value) ? std::max(most, std::abs(value)) : most;
      });
      const auto view = scene.model().view(state);
      for (const bool is_known : {false, true}) {
        if (is_known) view->evaluate(output.name);
        for (int node = 0; node < nodes; node += 3) {
          const auto own = view->evaluate_at(output.name, node, output.components);
          ASSERT_EQ(std::ssize(own), output.components) << output.name;
          for (int c = 0; c < output.components; ++c) {
            const double given = own[static_cast<std::size_t>(c)],
                         wanted = all[static_cast<std::size_t>(node * output.components + c)];
            ASSERT_EQ(std::isnan(given), std::isnan(wanted)) << output.name << " at node " << node;
            if (std::isnan(given)) continue;
            ASSERT_NEAR(given, wanted, 1e-11 * largest) << output.name << " at node " << node;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace orthodyn::state_view_test
