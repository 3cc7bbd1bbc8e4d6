// Warnings of the result of a run.
#include "lib/simulation/run/result_warnings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/simulation/run/model_summary.h"

namespace orthodyn::result_warnings_test {
namespace {

using testing::HasSubstr;
using testing::Not;

RunResult drifting(bool has_barrier) {
  RunResult result;
  result.model.has_barrier = has_barrier;
  result.motion.emplace();
  result.motion->energy.emplace();
  result.motion->energy->relative_drift = 0.1;
  result.motion->energy->states = 100;
  return result;
}

TEST(ResultWarnings, ADriftOfTheBalanceNamesTheGapOfABarrier) {
  const auto of = [](bool has_barrier) { return result_warnings(drifting(has_barrier)); };
  ASSERT_EQ(of(true).size(), 1u);
  EXPECT_THAT(of(true)[0], HasSubstr("drifts by 0.1 of the largest energy"));
  EXPECT_THAT(of(true)[0], HasSubstr("gap"));
  EXPECT_THAT(of(true)[0], HasSubstr("integrator.rtol"));
  ASSERT_EQ(of(false).size(), 1u);
  EXPECT_THAT(of(false)[0], HasSubstr("integrator.rtol"));
  EXPECT_THAT(of(false)[0], Not(HasSubstr("gap")));
}

TEST(ResultWarnings, KnowBarriersByTheModel) {
  const auto has_barrier = [](const std::string& type) {
    return summarize(set_up(Config::from_text(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 1, 0.5], cells: [1, 1, 1], order: 1}}}}
    upper: {{mesh: {{type: box, size: [0.6, 0.6, 0.5], cells: [1, 1, 1], order: 1}}, translation: [0.17, 0.13, 0.6]}}
materials: {{m: {{type: isotropic, density: 1, young: 10, nu: 0.3}}}}
terms: [{{type: {}, between: [lower, upper], stiffness: 20}}]
time: {{end: 1}}
)",
                                                          type))))
        .has_barrier;
  };
  EXPECT_TRUE(has_barrier("barrier_contact"));
  EXPECT_FALSE(has_barrier("contact"));
}

}  // namespace
}  // namespace orthodyn::result_warnings_test
