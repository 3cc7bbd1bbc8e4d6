// `orthodyn run` of buckling analyses.
#include <cmath>
#include <numbers>

#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::buckling_run_test {
namespace {

const char* const kColumn = R"(analysis: buckling
mesh: {type: box, size: [1, 0.05, 0.01], cells: [20, 1, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-1, 0, 0]}]
buckling: {count: 3}
)";

class BucklingRun : public InFolder {};

TEST_F(BucklingRun, TellsFactorsAndWritesShapes) {
  write("column.yaml", kColumn);
  const auto result = orthodyn("run column.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto rows = read_rows(folder_ / "out/buckling.csv");
  ASSERT_EQ(rows.size(), 3u);
  const double euler = std::numbers::pi * std::numbers::pi / 4 * 1e9 * 0.05 * 1e-6 / 12;
  EXPECT_NEAR(rows[0][1], euler, 0.005 * euler);
  for (const char* file : {"modes.pvd", "modes/mode_003.vtu", "scene.yaml", "run.json"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  EXPECT_NE(read_text(folder_ / "out/run.json").find("\"analysis\": \"buckling\""), std::string::npos);
  EXPECT_EQ(orthodyn("run out/scene.yaml --out again --quiet").exit_code, 0);
}

TEST_F(BucklingRun, OfALoadThatPullsFailsWithTheReason) {
  write("column.yaml", kColumn);
  const auto result = orthodyn("run column.yaml --out out --set 'loads.0.force=[1, 0, 0]'");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.output.find("no positive critical load factor"), std::string::npos) << result.output;
}

TEST_F(BucklingRun, RefusesWhatHasNoEffect) {
  const struct {
    const char *more, *says;
  } cases[] = {{"output: {probes: {top: {at: [1, 0, 0]}}}", "load factors and shapes only"},
               {"output: {extremes: [von_mises.largest]}", "load factors and shapes only"},
               {"statics: {max_steps: 3}", "no effect in a linear buckling analysis"},
               {"motions: [{surface: x1, translation: [-1, 0, 0], factor: {type: constant}}]",
                "not supported in a buckling analysis"},
               {"integrator: {type: newmark}", "integrator"}};
  for (const auto& [more, says] : cases) {
    write("column.yaml", kColumn + std::string(more) + "\n");
    const auto result = orthodyn("run column.yaml --out out");
    EXPECT_EQ(result.exit_code, 2) << more << "\n" << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << more << "\n" << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << more;
  }
}

}  // namespace
}  // namespace orthodyn::buckling_run_test
