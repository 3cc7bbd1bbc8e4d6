// Fits of stiffness factors on a grid: a bar in series has a closed form.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fit_field_test {
namespace {

using testing::HasSubstr;

constexpr std::array kTruth{1.0, 0.4, 0.9, 1.6};
constexpr double kPart = 100.0 * 0.5 / (1e9 * 0.02);  // m: extension of a part of factor 1

// A bar of four parts under tension without contraction across; a probe at the end of each part.
const char* const kBar = R"(
analysis: static
mesh: {type: box, size: [2, 0.1, 0.2], cells: [8, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
regions: {body: {material: m, stiffness_factors: {grid: [4, 1, 1]}}}
elasticity: {kinematics: linear}
clamps: [{surface: x0, components: [x]}, {nearest: [0, 0, 0]}, {nearest: [0, 0.1, 0], components: [z]}]
loads: [{surface: x1, force: [100, 0, 0]}]
output: {probes: {p0: {at: [0.5, 0, 0]}, p1: {at: [1, 0, 0]}, p2: {at: [1.5, 0, 0]}, p3: {at: [2, 0, 0]}}}
)";

class FitOfAField : public InFolder {
 protected:
  FitOfAField() { write("bar.yaml", kBar); }

  // Displacements of the probes in `measured` with the true factors.
  std::string fit_of(const std::vector<int>& measured, const std::string& field) const {
    std::string text = "experiments:\n  tension:\n    scene: bar.yaml\n    measured:\n";
    double u = 0;
    for (int k = 0; k < 4; ++k) {
      u += kPart / kTruth[static_cast<std::size_t>(k)];
      if (std::find(measured.begin(), measured.end(), k) != measured.end())
        text += fmt::format("      - {{quantity: p{}.displacement.x, value: {:.16g}, deviation: 1e-9}}\n", k, u);
    }
    return text + "parameters:\n  s: " + field + "\n";
  }
  CommandResult fit(const std::string& text) const {
    write("f.yaml", text);
    return orthodyn("fit f.yaml --no-report");
  }
  std::vector<double> factors() const {
    const Json table = Json::parse(read_text(folder_ / "out/fits/f/fit.json"));
    return table.at("fields").at(0).at("factors").get<std::vector<double>>();
  }
};

TEST_F(FitOfAField, FindsTheFactorsIfTheDataDetermineThem) {
  const CommandResult result = fit(fit_of({0, 1, 2, 3}, "{path: regions.body.stiffness_factors, smoothness: 1000}"));
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("s: 4 factors from 0.4 at (0.75, 0.05, 0.1) m to 1.6"));
  const std::vector<double> found = factors();
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k], kTruth[k], 1e-6) << k;
}

// With the total extension alone and equal expected factors, all factors are the harmonic mean.
TEST_F(FitOfAField, SpreadsWhatTheDataDoNotDetermine) {
  const CommandResult result = fit(fit_of({3}, "{path: regions.body.stiffness_factors, smoothness: 0.2}"));
  ASSERT_EQ(result.exit_code, 0) << result.output;
  double compliance = 0;
  for (const double factor : kTruth) compliance += 1 / factor / 4;
  for (const double factor : factors()) EXPECT_NEAR(factor, 1 / compliance, 1e-5);
}

// A scene reads the file that the fit writes.
TEST_F(FitOfAField, WritesAFileForScenes) {
  ASSERT_EQ(fit(fit_of({0, 1, 2, 3}, "{path: regions.body.stiffness_factors, smoothness: 1000}")).exit_code, 0);
  const CommandResult result = orthodyn(
      "gradient bar.yaml --set 'regions.body.stiffness_factors={grid: [4, 1, 1], file: out/fits/f/s.csv}' --of "
      "p3.displacement.x --by materials.m.young");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  double u = 0;
  for (const double factor : kTruth) u += kPart / factor;
  EXPECT_THAT(result.output, HasSubstr(fmt::format("p3.displacement.x = {:.6g} m", u)));
}

TEST_F(FitOfAField, IsRefusedWithTheReason) {
  EXPECT_THAT(fit(fit_of({3}, "regions.body.stiffness_factors")).output, HasSubstr("'smoothness' is missing"));
  EXPECT_THAT(fit(fit_of({3}, "{path: materials.m.young, smoothness: 0.1}")).output, HasSubstr("is none"));
  EXPECT_THAT(fit(fit_of({3}, "{path: regions.body.stiffness_factors, smoothness: 0.1, start: -1}")).output,
              HasSubstr("positive"));
  std::string many = kBar;
  many.replace(many.find("grid: [4, 1, 1]"), 15, "grid: [4, 501, 1]");
  write("bar.yaml", many);
  EXPECT_THAT(fit(fit_of({3}, "{path: regions.body.stiffness_factors, smoothness: 0.1}")).output,
              HasSubstr("has 2004 cells, and a fit finds at most 2000 factors"));
  std::string moving = kBar;
  moving.replace(moving.find("analysis: static"), 16, "time: {end: 0.01}\nintegrator: {type: cvode_bdf}");
  write("bar.yaml", moving);
  EXPECT_THAT(fit(fit_of({3}, "{path: regions.body.stiffness_factors, smoothness: 0.1}")).output,
              HasSubstr("is neither"));
}

}  // namespace
}  // namespace orthodyn::fit_field_test
