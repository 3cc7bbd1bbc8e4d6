// What is computed of one point of a sweep or of a refinement: the border, as JSON, between the process that wants it
// and the one that evaluates.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lib/ode/statistics.h"
#include "lib/study/jobs/job_result.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn::study {

// What is to be done.
struct EvaluationInput {
  Named<WantedMetric> metrics;
  std::optional<std::string> frame = {};  // the field that its picture shows
  std::optional<double> frame_at = {};    // s; default the end
  double seconds = 60;                    // limit of the integration
  std::string code;                       // fingerprint of the program that is to do it
  bool mesh_error = false;                // whether to estimate it
};

// What people read (title, unit, closed form) does not change what is computed, and is left out.
Json to_json(const EvaluationInput& input);
EvaluationInput evaluation_input_from(const Json& json);

struct EvaluationCost {
  double cpu_seconds = 0, wall_seconds = 0;
  std::optional<Statistics> statistics;  // of a motion or an equilibrium; none of modes alone
  double peak_memory = 0;                // bytes
};

Json to_json(const EvaluationCost& cost);

// What came out: of a failure all that was known by then.
struct EvaluationResult {
  std::optional<Failure> failure;                 // else it was completed
  Named<double> metrics;                          // SI; NaN for one that the point does not have
  Named<std::string> units;                       // of the metrics
  std::optional<EvaluationCost> cost;             // of the motion or the equilibrium, or else of modes alone
  std::optional<EvaluationCost> modes_cost;       // of natural frequencies, where some are wanted
  std::optional<std::size_t> unknowns, elements;  // of the model
  std::string frame;                              // the file of the picture's state; "" for none
  std::optional<double> mesh_error;               // MeshError::relative, of the motion or the equilibrium
  Named<double> metric_errors;                    // of frequencies and buckling loads: by what share they are too high
  std::string kinematics;                         // what was taken for `auto`, and why; "" where the scene says which
  std::vector<std::string> warnings;              // of the scene's set-up: slips, strain limits
};

// The value of a metric, in any unit, with the digits that its own error by the mesh leaves; six where none is known.
std::string known_value(const EvaluationResult& result, const std::string& metric, double value);

Json to_json(const EvaluationResult& result);
EvaluationResult evaluation_from(const Json& json);

}  // namespace orthodyn::study
