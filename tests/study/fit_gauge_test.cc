// `orthodyn fit` with strain gauges: known moduli are recovered from strains in equilibrium and over time.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fit_gauge_test {
namespace {

// A bar with the strain F / (E A) = 0.05 for E = 1 GPa.
const char* const kBar = R"(
analysis: static
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [3, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1.5 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [1e6, 0, 0]}]
output: {gauges: {g: {from: [0.1, 0.05, 0.2], to: [0.37, 0.05, 0.2]}}}
)";

class FitOfGauges : public InFolder {
 protected:
  Json fit(const std::string& text) const {
    write("f.yaml", text);
    const CommandResult result = orthodyn("fit f.yaml --no-report");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return Json::parse(read_text(folder_ / "out/fits/f/fit.json"));
  }
};

TEST_F(FitOfGauges, FindsAModulusFromAStrain) {
  write("bar.yaml", kBar);
  const Json found = fit(R"(
experiments: {pull: {scene: bar.yaml, measured: [{quantity: g.strain, value: 0.05, relative: 0.01}]}}
parameters: {E: materials.m.young}
refine: false
)");
  EXPECT_NEAR(found["parameters"][0]["value"].get<double>(), 1, 1e-6);  // GPa
  // The strain is proportional to 1/E, so both have the same relative error.
  EXPECT_NEAR(found["parameters"][0]["deviation"].get<double>(), 0.01, 1e-6);
}

// A stepped load: the strain of a clamped bar over time, of a run with the modulus that is to be found.
TEST_F(FitOfGauges, FindsAModulusFromATable) {
  const std::string more = "damping: {stiffness: 1 ms}\ntime: {end: 0.01}\nintegrator: {type: cvode_bdf, rtol: 1e-7}\n";
  std::string scene = kBar;
  scene.replace(scene.find("analysis: static"), 16, more);
  write("bar.yaml", scene);
  const CommandResult run =
      orthodyn("run bar.yaml --quiet --out true --set materials.m.young=1e9 --set output.frames=20");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  std::istringstream probes(read_text(folder_ / "true/probes.csv"));
  std::string line, table = "t,reading\n";
  std::getline(probes, line);
  ASSERT_EQ(line, "t [s],g.length [m],g.strain [1]");
  std::getline(probes, line);  // the start
  while (std::getline(probes, line)) table += line.substr(0, line.find(',')) + line.substr(line.rfind(',')) + "\n";
  write("strain.csv", table);
  const Json found = fit(R"(
experiments:
  pull: {scene: bar.yaml, measured: [{quantity: g.strain, table: strain.csv, column: reading, deviation: 0.0001}]}
parameters: {E: materials.m.young}
refine: false
)");
  EXPECT_NEAR(found["parameters"][0]["value"].get<double>(), 1, 1e-4);
  EXPECT_LT(found["attempts"][0]["evaluations"].get<int>(), 15);  // its derivatives come with the runs
}

}  // namespace
}  // namespace orthodyn::fit_gauge_test
