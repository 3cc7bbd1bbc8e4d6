// The evaluation of one point of a sweep or of one mesh of a convergence study: its input and its result, exchanged as
// JSON between the process of the study and the one that computes the point.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/core/ranks.h"
#include "lib/study/jobs/job_result.h"
#include "lib/study/quantities/evaluation_cost.h"
#include "lib/study/quantities/mode_matching.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn::study {

struct EvaluationInput {
  Named<WantedMetric> metrics;
  std::optional<std::string> frame = {};     // the field shown by the point's picture; empty for no picture
  std::optional<double> frame_at = {};       // time of the picture, s; empty for the end
  double seconds = 60;                       // wall time limit of the integration, s
  std::string code;                          // fingerprint of the program that must do the work
  bool mesh_error = false;                   // also estimate the mesh error
  std::vector<std::string> parameters = {};  // numbers of the scene for derivatives of the metrics, by path
  std::vector<ModeMatching> matchings = {};  // of WantedMetric::matching, about rest
};

// Title, unit, closed form and scale of a metric are left out, because they do not affect the computation.
Json to_json(const EvaluationInput& input);
EvaluationInput evaluation_input_from(const Json& json);

struct EvaluationModel {
  std::size_t unknowns = 0, elements = 0;
};

// Result of an evaluation. After a failure, it holds all that was known by then.
struct EvaluationResult {
  std::optional<Failure> failure;      // empty if completed
  Named<double> metrics;               // SI; NaN for a metric that the point does not have
  Named<std::string> units;            // SI units of the metrics
  std::optional<EvaluationCost> cost;  // of the motion or the equilibrium; of the modes if nothing else was computed
  std::optional<EvaluationCost> modes_cost;  // of natural frequencies and buckling loads
  std::optional<EvaluationModel> model;
  std::string frame;                 // file of the picture's state, relative to the point's folder; "" for none
  std::optional<double> mesh_error;  // MeshError::relative, of the motion or the equilibrium
  Named<double> metric_errors;       // estimated relative excess of natural frequencies
  // By metric: its derivative with respect to each of the input's parameters, in SI units. Quantities in equilibrium,
  // natural frequencies about rest and critical load factors have derivatives.
  Named<std::vector<double>> derivatives;
  Named<ModeMatch> matches;  // by metric with WantedMetric::matching
  std::string kinematics;    // choice made for `kinematics: auto` and its reason; "" for other kinematics
  std::vector<std::string> warnings;
};

// `value` of a metric, in any unit, as text. It has the digits that the metric's own mesh error justifies, or six if
// that error is unknown.
std::string known_value(const EvaluationResult& result, const std::string& metric, double value);

Json to_json(const EvaluationCost& cost);
Json to_json(const EvaluationResult& result);
EvaluationResult evaluation_from(const Json& json);

// File with the state shown by the picture, in the point's folder.
inline constexpr const char* kFrameFile = "frame.vtu";

// Computes the metrics of a scene and nothing that they do not need. `ranks`: the processes that share the computation;
// each must call this function. Null for one process. A failed run is a result, not an exception. Throws ConfigError,
// RunError.
EvaluationResult evaluate_point(const Config& scene, const EvaluationInput& input, const std::filesystem::path& folder,
                                const Ranks* ranks = nullptr);

// Does the job in `folder`. Throws as serve_job() does.
void evaluate_point(const std::filesystem::path& folder, const Ranks* ranks);

}  // namespace orthodyn::study
