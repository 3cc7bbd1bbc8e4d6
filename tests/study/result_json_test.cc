// Results written as JSON and read again are unchanged.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lib/study/compare/measurement_result.h"
#include "lib/study/jobs/json_values.h"
#include "lib/study/points/evaluation.h"
#include "lib/study/stability/stability_result.h"

namespace orthodyn::study::result_json_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// As text, as in a file between processes.
Json sent(const Json& json) { return Json::parse(to_text(json)); }

Statistics statistics() {
  Statistics s{101, 7, 5, 2, 303, 1, {404, 0.5}, {55, 0.25}, {66, 0.125}, {707, 1.0 / 3}};
  return s;
}

TrajectoryErrors errors(double size) {
  return {{size, 2 * size, 3 * size},
          {4 * size, kNaN, 5 * size},
          {{"tip", {size, size, size}}},
          {{"strain", {size, 0, kNaN}}},
          kNaN};
}

compare::MeasurementResult measured() {
  compare::MeasurementResult r;
  r.model = compare::ModelSize{12, 34, 56, 0, 0.5};
  r.decisions = Named<std::string>{{"method", "cvode_bdf"}, {"linear_solver", "cholmod"}};
  r.time_reached = 0.5;
  r.factor_bytes = 1024;
  r.repeats = 3;
  r.wall = compare::Spread{0.1, 0.05, 1.0 / 3};
  r.cpu = compare::Spread{0.2, 0.1, 0.3};
  r.peak_memory = 5e7;
  r.statistics = statistics();
  r.kind = compare::MeasurementResult::Kind::computed;
  r.drift = compare::Drift{1e-7, kNaN, 1e-9};
  r.drift_over_time = compare::EnergyChange{{0, 0.25, 0.5}, {0, -1e-8, kNaN}};
  r.smallest_det_f = 0.75;
  r.errors = errors(1e-5);
  return r;
}

TEST(MeasurementResult, IsReadAsItWasWritten) {
  const Json json = sent(to_json(measured()));
  const auto read = compare::measurement_from(json);
  EXPECT_EQ(sent(to_json(read)), json);
  EXPECT_FALSE(read.failure);
  EXPECT_EQ(read.decisions, measured().decisions);
  EXPECT_EQ(read.wall->max, 1.0 / 3);
  EXPECT_EQ(read.statistics->solve.seconds, 1.0 / 3);
  EXPECT_EQ(read.errors->displacement.l2, 2e-5);
  EXPECT_TRUE(std::isnan(read.errors->velocity.l2));
  EXPECT_TRUE(std::isnan(read.drift->linear_momentum));
  EXPECT_EQ(read.drift_over_time->times, (std::vector<double>{0, 0.25, 0.5}));
  EXPECT_TRUE(std::isnan(read.drift_over_time->changes[2]));
}

TEST(MeasurementResult, OfAReferenceIsReadAsItWasWritten) {
  compare::MeasurementResult exact;
  exact.model = compare::ModelSize{1, 2, 3, 0, 1};
  exact.kind = compare::MeasurementResult::Kind::exact;
  exact.own_errors = errors(1e-15);
  exact.scales = TrajectoryScales{0.5, 2, {{"tip", 0.25}}, {{"strain", 0.5}}, kNaN};
  const Json json = sent(to_json(exact));
  const auto read = compare::measurement_from(json);
  EXPECT_EQ(sent(to_json(read)), json);
  EXPECT_EQ(read.kind, compare::MeasurementResult::Kind::exact);
  EXPECT_EQ(read.scales->probes, exact.scales->probes);
  EXPECT_FALSE(read.statistics);
}

TEST(MeasurementResult, OfAFailureTellsWhatWasKnown) {
  auto failed = measured();
  failed.repeats.reset();
  failed.wall.reset();
  failed.cpu.reset();
  failed.peak_memory.reset();
  failed.kind.reset();
  failed.drift.reset();
  failed.drift_over_time.reset();
  failed.smallest_det_f.reset();
  failed.errors.reset();
  failed.factor_bytes.reset();
  failed.failure = Failure{"too many steps", "stopped at t = 0.5 s"};
  const Json json = sent(to_json(failed));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"status", "reason", "message", "time_reached", "statistics", "decisions",
                                            "model"}));
  const auto read = compare::measurement_from(json);
  ASSERT_TRUE(read.failure);
  EXPECT_EQ(read.failure->reason, "too many steps");
  EXPECT_EQ(sent(to_json(read)), json);
}

TEST(MeasurementInput, IsReadAsItWasWritten) {
  const compare::MeasurementInput input{3,     40, 1.5, "/somewhere/else", true, false, true, {"von_mises.largest"},
                                        "c0de"};
  EXPECT_EQ(to_json(compare::measurement_input_from(sent(to_json(input)))), to_json(input));
}

TEST(EvaluationResult, IsReadAsItWasWritten) {
  EvaluationResult r;
  r.metrics = {{"far", 1.0 / 3}, {"hertz", kNaN}};
  r.units = {{"far", "m"}, {"hertz", "Hz"}};
  Statistics s;
  s.steps = 11, s.force.count = 22;
  r.cost = EvaluationCost{.cpu_seconds = 0.5, .wall_seconds = 0.75, .peak_memory = 1e8};
  r.cost->count(s);
  r.model = EvaluationModel{3, 6};
  r.frame = "frame.vtu";
  r.kinematics = "linear";
  const Json json = sent(to_json(r));
  const auto read = evaluation_from(json);
  EXPECT_EQ(sent(to_json(read)), json);
  EXPECT_EQ(read.metrics[0], r.metrics[0]);
  EXPECT_TRUE(std::isnan(read.metrics[1].second));
  EXPECT_EQ(read.units, r.units);
  EXPECT_EQ(read.kinematics, r.kinematics);
  EXPECT_EQ(read.cost->forces, 22);
}

TEST(EvaluationResult, OfModesAloneHasNoCountsOfSteps) {
  EvaluationResult r;
  r.cost = EvaluationCost{.cpu_seconds = 0.5, .wall_seconds = 0.75, .peak_memory = 1e8};
  const Json json = sent(to_json(r));
  EXPECT_FALSE(json.at("cost").contains("steps"));
  EXPECT_FALSE(evaluation_from(json).cost->steps);
}

TEST(EvaluationResult, OfAFailureKeepsItsReason) {
  EvaluationResult r;
  r.failure = Failure{"time limit", "reached t = 1"};
  const auto read = evaluation_from(sent(to_json(r)));
  ASSERT_TRUE(read.failure);
  EXPECT_EQ(read.failure->message, "reached t = 1");
}

TEST(EvaluationInput, IsReadAsItWasWritten) {
  EvaluationInput input;
  WantedMetric motion, mode, factor;
  motion.quantity = "tip.displacement.z", motion.take = TimeReduction::frequency, motion.at = 0.5;
  mode.along = Component::y, mode.about_equilibrium = true;
  factor.buckling = 2;
  input.metrics = {{"a", motion}, {"b", mode}, {"c", factor}};
  input.frame = "stress", input.frame_at = 0.25, input.code = "c0de";
  const auto read = evaluation_input_from(sent(to_json(input)));
  EXPECT_EQ(to_json(read), to_json(input));
  EXPECT_EQ(read.metrics[0].second.take, TimeReduction::frequency);
  EXPECT_EQ(read.metrics[1].second.along, Component::y);
  EXPECT_EQ(read.metrics[2].second.buckling, 2);
}

TEST(StabilityResult, IsReadAsItWasWritten) {
  stability::StabilityResult r;
  r.run = stability::GradedRun{true,
                               "degraded",
                               "end of q is 2, expected 1 +- 0.1",
                               stability::WorstMetric{"end of q", "m", kNaN, 1, 0.1, "a book", "round-off"},
                               2,
                               0.5,
                               0.25,
                               statistics()};
  r.at = "2026-01-31T12:00:00Z";
  const Json json = sent(to_json(r));
  const auto read = stability::stability_result_from(json);
  EXPECT_EQ(sent(to_json(read)), json);
  EXPECT_EQ(read.grade(), "degraded");
  EXPECT_TRUE(std::isnan(read.run->worst->computed));
  EXPECT_EQ(read.run->statistics->tangent.count, 55);
}

// Without a grade: refused by the integrator, killed or crashed.
TEST(StabilityResult, WithoutAGradeIsARefusalOrAFailure) {
  const auto of = [](const char* reason) {
    return stability::stability_result_from(sent(to_json(Failure{reason, "what was said"})));
  };
  EXPECT_EQ(of(kRefused).grade(), "refused");
  EXPECT_EQ(of(kRefused).reason(), "what was said");
  EXPECT_EQ(of(kTimeLimit).grade(), "fail");
  EXPECT_EQ(of(kTimeLimit).reason(), kTimeLimit);
  EXPECT_EQ(of(kCrashed).reason(), "what was said");
}

}  // namespace
}  // namespace orthodyn::study::result_json_test
