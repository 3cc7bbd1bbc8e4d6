// The scenes in configs/vega, with meshes of Vega FEM; skipped without them in $ORTHODYN_DATA.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "lib/simulation/run/setup.h"
#include "tests/problems/running.h"

namespace orthodyn::vega_scenes_test {
namespace {

namespace fs = std::filesystem;

struct VegaScene {
  const char *name, *mesh, *fixed;
  double
      largest_difference;  // difference of two integrators, rms over nodes and frames, relative to the largest motion
};

class VegaScenes : public testing::TestWithParam<VegaScene> {
 protected:
  void SetUp() override {
    const char* data = std::getenv("ORTHODYN_DATA");
    if (!data || !fs::exists(fs::path(data) / "veg" / GetParam().mesh))
      GTEST_SKIP() << "needs " << GetParam().mesh << " below $ORTHODYN_DATA/veg";
    folder_ = fs::path(data) / "veg";
  }

  // Displacements at all frames.
  std::vector<Vector> swing(const std::string& integrator) const {
    Config config = Config::from_file(std::string(ORTHODYN_SOURCE_DIR) + "/configs/vega/" + GetParam().name + ".yaml");
    config.override_with("mesh.file=" + (folder_ / GetParam().mesh).string());
    config.override_with("mesh.fixed=" + (folder_ / GetParam().fixed).string());
    config.override_with("integrator.type=" + integrator);
    const auto setup = set_up(config);
    std::vector<Vector> frames;
    Watch watch([&](const State& state) { frames.push_back(state.q); });
    const auto& time = setup.scene.time;
    const Plan plan{.end = time.end, .output_times = evenly_spaced(time.start, time.end, 200)};
    const Outcome outcome = run(*setup.built.model, *setup.integrator, setup.built.initial, plan, {&watch}, {false});
    EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    return frames;
  }

  fs::path folder_;
};

INSTANTIATE_TEST_SUITE_P(Meshes, VegaScenes,
                         testing::Values(VegaScene{"turtle", "turtle/turtle-volumetric-heterogeneous.ortho.veg",
                                                   "turtle/turtle-volumetric.bou", 0.010},
                                         VegaScene{"simple_bridge", "simple_bridge/simpleBridge-ic_128_0.15_.1.veg",
                                                   "simple_bridge/simpleBridge.bou", 0.005}),
                         [](const auto& tested) { return std::string(tested.param.name); });

// The bounds were reached by a prototype with the same integrators and tolerance.
TEST_P(VegaScenes, SwingAlikeByTwoIntegrators) {
  const auto cvode = swing("cvode_bdf"), ida = swing("ida_bdf");
  ASSERT_EQ(cvode.size(), 201u);
  ASSERT_EQ(ida.size(), 201u);
  double squares = 0, largest = 0;
  for (std::size_t k = 0; k < cvode.size(); ++k) {
    squares += (cvode[k] - ida[k]).squaredNorm();
    largest = std::max(largest, cvode[k].reshaped(3, cvode[k].size() / 3).colwise().norm().maxCoeff());
  }
  const double nodes = static_cast<double>(cvode[0].size()) / 3;
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(std::sqrt(squares / (nodes * 201)) / largest, GetParam().largest_difference);
}

}  // namespace
}  // namespace orthodyn::vega_scenes_test
