// What is measured of one point of a comparison: the border, as JSON, between the process that compares and the one
// that measures.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/ode/statistics.h"
#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/study/jobs/job_result.h"

namespace orthodyn::study::compare {

// Errors, and the sizes that they are relative to.
Json to_json(const TrajectoryErrors& errors);
TrajectoryErrors errors_from(const Json& json);

Json to_json(const TrajectoryScales& scales);
TrajectoryScales scales_from(const Json& json);

// What is to be done.
struct MeasurementInput {
  int repeats = 1, samples = 100;
  double seconds = 60;                       // limit of one integration
  std::string reference;                     // folder of a reference's result; "" for none
  bool keep_trajectory = false;              // for others to be measured against
  bool exact_if_possible = false;            // the exact solution in place of an integration, where there is one
  bool at_probes = false;                    // errors of the probes alone: the reference has another mesh
  std::vector<std::string> quantities = {};  // whose errors are measured too
  std::string code;                          // fingerprint of the program that is to do it
};

Json to_json(const MeasurementInput& input);
MeasurementInput measurement_input_from(const Json& json);

struct ModelSize {
  std::size_t unknowns = 0, elements = 0, nodes = 0;
  double start = 0, end = 0;  // of time, s
  int order = 1;              // of the elements
};

struct Spread {
  double median = 0, min = 0, max = 0;
};

// Precondition: not empty.
Spread spread(std::vector<double> values);

// Of the undisturbed runs.
struct Timing {
  std::size_t repeats = 0;
  Spread wall, cpu;        // s
  double peak_memory = 0;  // bytes
};

// By how much what should be constant has changed, relative; NaN where it need not be constant.
struct Drift {
  double energy = 0, linear_momentum = 0, angular_momentum = 0;
};

struct EnergyChange {
  std::vector<double> times, changes;  // s; relative
};

// What came out: of a failure all that was known by then.
struct MeasurementResult {
  enum class Kind { exact, computed };

  std::optional<Failure> failure;  // else it was completed
  std::optional<ModelSize> model;
  std::vector<std::pair<std::string, std::string>> decisions;  // of the integrator
  std::optional<double> time_reached;                          // s
  std::optional<std::size_t> factor_bytes;
  std::optional<Timing> timing;
  std::optional<Statistics> statistics;  // of the run with the median time
  std::optional<Kind> kind;
  std::optional<TrajectoryErrors> own_errors;  // what round-off may do to an exact solution
  std::optional<double> mesh_error;            // MeshError::relative, of a reference for other meshes
  std::optional<double> seconds;               // wall time of a run that was not timed
  std::optional<Drift> drift;
  std::optional<EnergyChange> drift_over_time;
  std::optional<double> smallest_det_f;  // NaN where none is known
  std::optional<TrajectoryScales> scales;
  std::optional<TrajectoryErrors> errors;  // against the reference
  std::string at;                          // when: 2026-01-31T12:00:00Z
};

// The keys of what is absent are absent.
Json to_json(const MeasurementResult& result);
MeasurementResult measurement_from(const Json& json);

}  // namespace orthodyn::study::compare
