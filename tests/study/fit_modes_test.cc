// `orthodyn fit` with natural frequencies that are matched by shape or by the nearest frequency.
#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/output/json.h"
#include "lib/simulation/run/setup.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fit_modes_test {
namespace {

// A free plate of spruce; the truth. Modes 3 and 4 have nearly the same frequency.
const char* const kPlate = R"(
mesh: {type: box, size: [0.3, 0.2, 0.004], cells: [8, 6, 1], elements: hexahedra}
mass: consistent
materials:
  spruce: {type: orthotropic, density: 430, young: [11 GPa, 0.9 GPa, 0.5 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.42,
           g12: 0.75 GPa, g23: 0.04 GPa, g13: 0.72 GPa}
regions: {body: {material: spruce}}
time: {end: 1}
)";

// A start from which some modes have another order. With the errors of configs/fits/spruce_plate.yaml, the search by
// order ends at a crossing of modes 3 and 4.
constexpr double kErrors[] = {1.0011, 1.0061, 0.9953, 1.0047, 0.9986, 0.9985, 1.0096, 1.0008};
const char* const kFarStart = R"(
refine: false
parameters:
  E1: {path: materials.spruce.young.0, start: 8 GPa}
  E2: {path: materials.spruce.young.1, start: 0.6 GPa}
  G12: {path: materials.spruce.g12, start: 1 GPa}
  nu12: {path: materials.spruce.nu12, start: 0.3}
)";

constexpr int kRigid = 6;

// Frequencies of the elastic modes, and amplitudes along z at a grid of points of the upper side.
struct Measured {
  std::vector<double> frequencies;
  std::vector<Vec3> points;
  std::vector<std::vector<double>> shapes;
};

Measured measure(int count) {
  const Setup setup = set_up(Config::from_text(kPlate));
  const FemModel& model = *setup.built.model;
  const Vector zero = Vector::Zero(model.num_dofs());
  Measured out;
  std::vector<int> nodes;
  for (const double x : {0.0, 0.075, 0.15, 0.225, 0.3})
    for (const double y : {0.0, 0.1, 0.2}) {
      nodes.push_back(nearest_node(model.parts().mesh, {x, y, 0.004}));
      out.points.push_back(model.parts().mesh.node(nodes.back()));
    }
  const Modes modes = natural_modes(model, {0, zero, zero, 0}, kRigid + count);
  for (int k = kRigid; k < kRigid + count; ++k) {
    const Mode& mode = modes.modes[static_cast<std::size_t>(k)];
    out.frequencies.push_back(mode.frequency());
    const auto u = model.evaluate("displacement", {0, mode.shape, zero});
    std::vector<double>& shape = out.shapes.emplace_back();
    for (const int node : nodes) shape.push_back(u[3 * static_cast<std::size_t>(node) + 2]);
  }
  return out;
}

// The table with columns mode 1, mode 2, ..., each with another scale and sign.
std::string table_of(const Measured& measured) {
  std::string text = "x [mm],y [mm],z [mm]";
  for (std::size_t k = 0; k < measured.shapes.size(); ++k) text += fmt::format(",mode {} [um/s]", k + 1);
  for (std::size_t p = 0; p < measured.points.size(); ++p) {
    const Vec3 at = 1000 * measured.points[p];
    text += fmt::format("\n{},{},{}", at[0], at[1], at[2]);
    for (std::size_t k = 0; k < measured.shapes.size(); ++k)
      text += k == 2 && p == 4 ? "," : fmt::format(",{}", (k % 2 == 0 ? -3 : 40) * measured.shapes[k][p]);
  }
  return text + "\n";
}

std::string list_of(const std::vector<double>& frequencies) {
  return fmt::format("[{:.12g}]", fmt::join(frequencies, ", "));
}

class FitModes : public InFolder {
 protected:
  FitModes() { write("plate.yaml", kPlate); }
  // `keys`: of the measured frequencies, beside `relative`.
  CommandResult fit(const std::string& keys, const std::string& rest) const {
    write("f.yaml", "experiments: {plate: {scene: plate.yaml, measured: [{" + keys + ", relative: 0.005}]}}\n" + rest);
    return orthodyn("fit f.yaml --no-report");
  }
  Json table() const { return Json::parse(read_text(folder_ / "out/fits/f/fit.json")); }
  double chi_square() const { return table().at("noise").at("chi_square").get<double>(); }
  void expect_truth(double relative) const {
    const double truth[] = {11, 0.9, 0.75};
    for (std::size_t p = 0; p < 3; ++p)
      EXPECT_NEAR(table().at("parameters").at(p).at("value").get<double>(), truth[p], relative * truth[p]) << p;
  }
};

TEST_F(FitModes, ByShapeFindTheTruthFromWhereTheirOrderDoesNot) {
  Measured measured = measure(8);
  for (std::size_t k = 0; k < 8; ++k) measured.frequencies[k] *= kErrors[k];
  write("shapes.csv", table_of(measured));
  const std::string list = "frequencies: " + list_of(measured.frequencies);
  // 99 % of chi-square with four degrees of freedom
  const auto by_order = fit(list, kFarStart);
  EXPECT_GT(chi_square(), 13.28) << by_order.output;
  EXPECT_NE(by_order.output.find("give measured 'shapes'"), std::string::npos) << by_order.output;

  const auto by_shape = fit(list + ", shapes: shapes.csv, direction: [0, 0, 2]", kFarStart);
  ASSERT_EQ(by_shape.exit_code, 0) << by_shape.output;
  EXPECT_LT(chi_square(), 9.49);  // 95 % of chi-square with four degrees of freedom
  expect_truth(0.03);
  const Json data = table().at("data");
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(data.at(k).at("mode").get<int>(), static_cast<int>(k) + 1);
    EXPECT_NEAR(data.at(k).at("mac").get<double>(), 1, 1e-3);
  }
  int changed = 0;
  for (const Json& datum : data) changed += datum.at("mode_at_start") != datum.at("mode");
  EXPECT_GT(changed, 0);
  EXPECT_NE(by_shape.output.find("plate: the search moved measured frequency"), std::string::npos) << by_shape.output;
}

// Frequencies 2 and 5 were missed in the measurement.
TEST_F(FitModes, ByTheNearestFrequencyLeaveOutMissedOnes) {
  const Measured all = measure(8);
  std::vector<double> some;
  for (const std::size_t k : {0u, 2u, 3u, 5u, 6u, 7u}) some.push_back(all.frequencies[k]);
  const std::string parameters = R"(
refine: false
parameters:
  E1: {path: materials.spruce.young.0, start: 10.6 GPa}
  E2: {path: materials.spruce.young.1, start: 0.87 GPa}
  G12: {path: materials.spruce.g12, start: 0.77 GPa}
)";
  const auto result = fit("frequencies: " + list_of(some) + ", match: nearest", parameters);
  ASSERT_EQ(result.exit_code, 0) << result.output;
  expect_truth(1e-4);
  EXPECT_EQ(table().at("data").at(5).at("mode").get<int>(), 8);
  EXPECT_TRUE(table().at("data").at(5).at("mac").is_null());
  EXPECT_NE(result.output.find("measured frequency 2 is computed mode 3"), std::string::npos) << result.output;

  const auto narrow = fit("frequencies: " + list_of({all.frequencies[0], 120}) + ", match: nearest, band: 0.05",
                          "parameters: {E1: {path: materials.spruce.young.0, start: 10.9 GPa}}\n");
  EXPECT_NE(narrow.exit_code, 0);
  EXPECT_NE(narrow.output.find("no computed mode is within 5 % of measured frequency 2 (120 Hz)"), std::string::npos)
      << narrow.output;
}

// Shapes of which one belongs to no mode, and of which two are the same.
TEST_F(FitModes, WarnOfShapesThatBelongToNoneOrToSeveral) {
  Measured measured = measure(4);
  for (std::size_t p = 0; p < measured.points.size(); ++p) measured.shapes[1][p] = p % 2 == 0 ? 1 : -1;
  measured.shapes[3] = measured.shapes[2];
  write("shapes.csv", table_of(measured));
  const auto result =
      fit("frequencies: " + list_of(measured.frequencies) + ", shapes: shapes.csv, direction: [0, 0, 1]",
          "refine: false\niterations: 2\nparameters: {E1: materials.spruce.young.0}\n");
  EXPECT_NE(result.output.find("measured frequency 2 ("), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("with a MAC of only"), std::string::npos) << result.output;
}

// Shapes tell which mode is meant, so that a list in another order gives the same result.
TEST_F(FitModes, ByShapeMayHaveAnyOrder) {
  Measured measured = measure(4);
  for (std::size_t k = 0; k < 4; ++k) measured.frequencies[k] *= kErrors[k];
  const auto value = [&] {
    write("shapes.csv", table_of(measured));
    const auto result =
        fit("frequencies: " + list_of(measured.frequencies) + ", shapes: shapes.csv, direction: [0, 0, 1]",
            "refine: false\nparameters: {E1: materials.spruce.young.0}\n");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return table().at("parameters").at(0).at("value").get<double>();
  };
  const double ascending = value();
  for (const auto& [a, b] : std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}, {1, 2}}) {
    std::swap(measured.frequencies[a], measured.frequencies[b]);
    std::swap(measured.shapes[a], measured.shapes[b]);
  }
  EXPECT_NEAR(value(), ascending, 1e-6 * ascending);
  EXPECT_EQ(table().at("data").at(0).at("mode").get<int>(), 4);
}

TEST_F(FitModes, AreRefusedInAHarmonicAnalysis) {
  std::string scene = kPlate;
  if (const auto time = scene.find("time:"); time != std::string::npos)
    scene.erase(time, scene.find('\n', time) - time);
  write("plate.yaml", scene +
                          "\nanalysis: harmonic\nclamps: [{surface: x0}]\noutput: {probes: {p: {at: [0.3, 0, 0]}}}\n"
                          "loads: [{surface: x1, force: [0, 0, 1], factor: {type: harmonic}}]\n"
                          "harmonic: {frequencies: [10 Hz], damping_ratio: 0.01}\n");
  const auto result = fit("mode: 1, value: 90", "parameters: {E1: materials.spruce.young.0}\n");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("the scene is a harmonic analysis, which computes responses only"), std::string::npos)
      << result.output;
  EXPECT_FALSE(fs::exists(folder_ / "out/fits/f/points"));
}

TEST_F(FitModes, RefuseMistakesBeforeAnythingRuns) {
  const std::string e1 = "parameters: {E1: materials.spruce.young.0}\n";
  const std::string list = "frequencies: [90, 140], ", shapes = "shapes: s.csv, direction: [0, 0, 1]";
  const std::string head = "x [mm],y [mm],z [mm],mode 1,mode 2\n", row = "0,0,4,1,2\n", other = "300,0,4,3,2\n";
  struct Wrong {
    std::string keys, table, message;
  };
  const Wrong wrong[] = {
      {list + shapes, "x [mm],y [mm],z [mm],mode 1\n0,0,4,1\n", "column 'mode 2' is missing"},
      {list + shapes, "x [mm],y [mm],z [mm],mode 1,mode 2,mode 3\n0,0,4,1,2,3\n",
       "column 'mode 3' belongs to no measured frequency, of which there are 2. The columns are"},
      {"frequencies: [90, null], " + shapes, head + row + other,
       "column 'mode 2' belongs to no measured frequency, of which there is 1. The columns are"},
      {list + shapes, head + row + "300,0,4,3\n", "found 4 entries where 5"},
      {list + shapes, head + row + other + "0,0,0.4,1,2\n0,100,400,1,2\n", "(0, 0.1, 0.4) m is 0.396 m away"},
      {list + shapes, "x,y,z,mode 1,mode 2\n0,0,4,1,2\n300,0,4,3,2\n", "check units"},
      {list + shapes, "x [kg],y [mm],z [mm],mode 1,mode 2\n0,0,4,1,2\n", "kg"},
      {list + shapes, head + row + "300,,4,3,2\n", "the point has no coordinate"},
      {list + shapes, head + "0,0,4,1,0\n300,0,4,3,0\n", "all amplitudes are zero"},
      {list + shapes, head + row + "300,0,4,3,\n", "has one amplitude"},
      {list + shapes, "x [mm],y [mm],x [m],z,mode 1,mode 2\n0,0,0,4,1,2\n", "column 'x' occurs twice"},
      {list + "shapes: s.csv, direction: [0, 0, 0]", head + row + other, "give a direction"},
      {list + "shapes: s.csv", head + row + other, "'direction' is missing"},
      {list + "shapes: other.csv, direction: [0, 0, 1]", head + row, "no such file"},
      {list + shapes, "x,y,z,Mode 1,mode 2\n0,0,4,1,2\n",
       "column 'Mode 1' belongs to no measured frequency, of which "
       "there are 2; did you mean 'mode 1'?"},
      {"frequencies: [140, 90]", "", "list them in ascending order (with 'shapes' any order is allowed)"},
      {"frequencies: [null, null]", "", "all are null"},
      {"mode: 1, value: 90, " + shapes, head + row + other, "a single 'mode' is matched by its number"},
      {"mode: 1, value: 90, match: nearest", "", "a single 'mode' is matched by its number"},
      {list + "direction: [0, 0, 1]", "", "is not used without 'shapes'"},
      {list + "match: shape", "", "matching by shape needs 'shapes'"},
      {list + "match: nearest, " + shapes, head + row + other, "'shapes' match modes by shape"},
      {list + "band: 0.1", "", "is not used without 'match: nearest'"}};
  for (const Wrong& one : wrong) {
    write("s.csv", one.table);
    const auto result = fit(one.keys, e1);
    EXPECT_EQ(result.exit_code, 2) << one.keys << one.table;
    EXPECT_NE(result.output.find(one.message), std::string::npos) << one.message << "\nin: " << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out/fits/f/points")) << one.keys << one.table;
  }
}

}  // namespace
}  // namespace orthodyn::fit_modes_test
