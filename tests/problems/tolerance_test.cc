// On shipped scenes the error falls with the tolerance for every method, and is small with default settings.
// configs/comparisons/tolerance.yaml measures it at full size.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/problems/running.h"

namespace orthodyn::tolerance_test {
namespace {

struct ScenePart {
  const char* name;
  const char* cells;              // of a coarser mesh
  const char* end;                // s
  const char* damping = nullptr;  // replaces the scene's
  const char* factor = nullptr;   // replaces that of the load
};
constexpr const char* kPulse = "{type: expression, formula: exp(-((t-0.01)/0.001)^2)}";
constexpr ScenePart kScenes[] = {{"twist", "[12, 2, 1]", "1.2"}, {"beam_lrt", "[8, 2, 2]", "0.6"}};

// Displacements at 50 times.
Eigen::MatrixXd motion_of(const ScenePart& part, const std::string& integrator) {
  Config config = Config::from_file(std::string(ORTHODYN_SOURCE_DIR "/configs/scenes/") + part.name + ".yaml");
  config.set_yaml("mesh.cells", part.cells);
  config.set_yaml("mesh.order", "1");
  config.set_yaml("time.end", part.end);
  config.set_yaml("integrator", integrator);
  if (part.damping) config.set_yaml("damping", part.damping);
  if (part.factor) config.set_yaml("loads.0.factor", part.factor);
  const BuiltTestScene s(config);
  Eigen::MatrixXd q(s.size(), 51);
  Eigen::Index column = 0;
  const Outcome outcome = run_scene(s, 50, [&](const State& state) { q.col(column++) = state.q; });
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_EQ(column, q.cols());
  return q;
}

constexpr const char* kReference = "{type: arkode_dirk, rtol: 1e-8}";

using Tested = std::tuple<const char*, ScenePart>;

class Tolerance : public testing::TestWithParam<Tested> {
 protected:
  static const Eigen::MatrixXd& reference() {
    static std::map<std::string, Eigen::MatrixXd> known;
    const auto [entry, is_new] = known.try_emplace(std::get<1>(GetParam()).name);
    if (is_new) entry->second = motion_of(std::get<1>(GetParam()), kReference);
    return entry->second;
  }

  static double error(double rtol) {
    const auto& [integrator, part] = GetParam();
    const auto q = motion_of(part, fmt::format("{{type: {}, rtol: {}}}", integrator, rtol));
    return (q - reference()).norm() / reference().norm();
  }
};

INSTANTIATE_TEST_SUITE_P(
    Methods, Tolerance,
    testing::Combine(testing::Values("arkode_dirk", "auto", "bathe", "cvode_bdf", "generalized_alpha", "hht_alpha",
                                     "ida_bdf", "newmark", "rosenbrock", "sdirk", "tr_bdf2"),
                     testing::ValuesIn(kScenes)),
    [](const auto& tested) { return fmt::format("{}_{}", std::get<0>(tested.param), std::get<1>(tested.param).name); });

TEST_P(Tolerance, DecidesOnTheErrorOfAScene) {
  const double loose = error(1e-3), middle = error(1e-4), tight = error(1e-5);
  EXPECT_LT(loose, 0.05);
  EXPECT_LT(middle, loose);
  EXPECT_LT(tight, middle);
  const double slope = std::log10(loose / tight) / 2;
  EXPECT_GT(slope, 0.5) << loose << " " << middle << " " << tight;
  EXPECT_LT(slope, 1.3) << loose << " " << middle << " " << tight;
}

class DefaultTolerance : public testing::TestWithParam<ScenePart> {};

INSTANTIATE_TEST_SUITE_P(Scenes, DefaultTolerance,
                         testing::Values(ScenePart{"cantilever", "[12, 2, 1]", "1"},
                                         ScenePart{"cantilever", "[12, 2, 1]", "0.5", "{stiffness: 1e-5}"},
                                         ScenePart{"cantilever", "[12, 2, 1]", "0.5", "~"},
                                         ScenePart{"cantilever", "[12, 2, 1]", "0.1", "{stiffness: 1e-4}", kPulse},
                                         ScenePart{"cantilever", "[12, 2, 1]", "0.1", "~", kPulse},
                                         ScenePart{"beam_lrt", "[8, 2, 2]", "0.6"},
                                         ScenePart{"beam_lrt", "[8, 2, 2]", "0.6", "~"},
                                         ScenePart{"twist", "[12, 2, 1]", "0.8"}));

// Default integrator at the default tolerance.
TEST_P(DefaultTolerance, KeepsTheMotionToOnePerCent) {
  const auto expected = motion_of(GetParam(), kReference);
  const double error = (motion_of(GetParam(), "~") - expected).lpNorm<Eigen::Infinity>();
  EXPECT_LT(error, 0.01 * expected.lpNorm<Eigen::Infinity>());
}

}  // namespace
}  // namespace orthodyn::tolerance_test
