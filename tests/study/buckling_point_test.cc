// Critical load factors as metrics of a point, with derivatives.
#include <gtest/gtest.h>

#include "lib/study/points/evaluation.h"

namespace orthodyn::study::buckling_point_test {
namespace {

const char* const kColumn = R"(
analysis: buckling
mesh: {type: box, size: [1, 0.05, 0.02], cells: [10, 2, 2]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-10, 0, 0]}]
)";

EvaluationResult evaluated(const std::string& more) {
  EvaluationInput input;
  input.metrics = {{"second", {.buckling = 2}}, {"first", {.buckling = 1}}, {"none", {.buckling = 900}}};
  input.parameters = {"materials.m.young", "loads.0.force.0"};
  return evaluate_point(Config::from_text(kColumn + more, "scene.yaml"), input, {});
}

// The factor is proportional to E / F.
TEST(BucklingPoint, HasDerivativesOfItsLoadFactors) {
  const EvaluationResult result = evaluated("");
  ASSERT_FALSE(result.failure);
  ASSERT_EQ(result.derivatives.size(), 2u);
  for (const std::size_t k : {0, 1}) {
    const auto& [name, derivatives] = result.derivatives[k];
    const auto& [metric, factor] = result.metrics[k];
    EXPECT_EQ(name, metric);
    ASSERT_EQ(derivatives.size(), 2u);
    EXPECT_NEAR(derivatives[0] * 1e9 / factor, 1, 1e-5) << name;
    EXPECT_NEAR(derivatives[1] * -10 / factor, -1, 1e-5) << name;
  }
}

TEST(BucklingPoint, HasNoDerivativesWithContact) {
  const EvaluationResult result = evaluated("terms: [{type: ground_contact, stiffness: 1000, point: [0, 0, -1]}]\n");
  ASSERT_FALSE(result.failure);
  EXPECT_GT(result.metrics.at(1).second, 0);
  EXPECT_TRUE(result.derivatives.empty());
}

}  // namespace
}  // namespace orthodyn::study::buckling_point_test
