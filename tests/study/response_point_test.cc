// Harmonic responses as metrics of a point, with derivatives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/study/points/evaluation.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::study::response_point_test {
namespace {

const char* const kPlate = R"(
analysis: harmonic
mesh: {type: box, size: [0.2, 0.1, 0.01], cells: [3, 2, 1]}
materials: {m: {type: isotropic, density: 450, young: 10e9, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 1], factor: {type: harmonic}}]
harmonic: {from: 50, to: 400, losses: {m: {factor: 0.03}}, rtol: 1e-8}
output: {probes: {tip: {at: [0.2, 0.1, 0.01], fields: [displacement, nodal_stress]}}}
)";

EvaluationResult evaluated(double young) {
  EvaluationInput input;
  const auto add = [&](const char* name, const char* quantity, ResponseMetric of, std::optional<double> frequency) {
    WantedMetric metric;
    metric.quantity = quantity, metric.response = of, metric.frequency = frequency;
    input.metrics.emplace_back(name, metric);
  };
  add("amplitude", "tip.displacement.z", ResponseMetric::amplitude, 150);
  add("phase", "tip.displacement.z", ResponseMetric::phase, 150);
  add("peak", "tip.displacement.z", ResponseMetric::peak, {});
  add("peak_frequency", "tip.displacement.z", ResponseMetric::peak_frequency, {});
  add("stress", "tip.nodal_stress.xx", ResponseMetric::amplitude, 150);
  input.parameters = {"materials.m.young"};
  Config scene = Config::from_text(kPlate, "scene.yaml");
  scene.set_yaml("materials.m.young", fmt::format("{}", young));
  return evaluate_point(scene, input, {});
}

TEST(ResponsePoint, HasDerivativesOfAmplitudePhaseAndPeak) {
  const double young = 10e9, step = 1e-3 * young;
  const EvaluationResult base = evaluated(young), more = evaluated(young + step), less = evaluated(young - step);
  ASSERT_FALSE(base.failure);
  ASSERT_EQ(base.derivatives.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [name, derivatives] = base.derivatives[k];
    EXPECT_EQ(name, base.metrics[k].first);
    ASSERT_EQ(derivatives.size(), 1u);
    const double difference = (more.metrics[k].second - less.metrics[k].second) / (2 * step);
    EXPECT_NEAR(derivatives[0], difference, 1e-4 * std::abs(difference)) << name;
  }
}

class ResponseFit : public InFolder {};

// Amplitude, phase and peak give the modulus and the loss factor. Their derivatives come with each run: differences
// would take four runs more per step.
TEST_F(ResponseFit, RecoversModulusAndLossFromFewRuns) {
  const EvaluationResult truth = evaluated(10e9);
  write("plate.yaml", kPlate);
  write("f.yaml", fmt::format(R"(
experiments:
  plate:
    scene: plate.yaml
    measured:
      - {{quantity: tip.displacement.z, frequency: 150, value: {}, relative: 0.01}}
      - {{quantity: tip.displacement.z, frequency: 150, response: phase, value: {}, deviation: 0.01}}
      - {{quantity: tip.displacement.z, response: peak, value: {}, relative: 0.01}}
parameters:
  E: {{path: materials.m.young, start: 9 GPa}}
  loss: {{path: harmonic.losses.m.factor, start: 0.02}}
refine: false
)",
                              truth.metrics[0].second, truth.metrics[1].second, truth.metrics[2].second));
  const auto result = orthodyn("fit f.yaml --no-report");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const Json fit = Json::parse(read_text(folder_ / "out/fits/f/fit.json"));
  EXPECT_NEAR(fit.at("parameters").at(0).at("value").get<double>(), 10e9, 1e5);
  EXPECT_NEAR(fit.at("parameters").at(1).at("value").get<double>(), 0.03, 1e-6);
  EXPECT_LT(fit.at("runs").get<int>(), 16);
}

}  // namespace
}  // namespace orthodyn::study::response_point_test
