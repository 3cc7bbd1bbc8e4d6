// One measurement of a comparison: its input and its result, exchanged as JSON between the process that compares and
// the one that measures. To add a quantity, add a member of MeasurementResult and a row in measurement_result.cc;
// compare.json and compare.csv follow from the rows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/ode/statistics.h"
#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/study/jobs/job_result.h"
#include "lib/study/jobs/json_fields.h"

namespace orthodyn::study::compare {

struct MeasurementInput {
  int repeats = 1, samples = 100;  // timed runs; times at which errors are measured
  double seconds = 60;             // wall time limit of a timed run, s
  std::string reference;           // folder of the reference's result; "" for none
  bool keep_trajectory = false;    // write the trajectory, with which other measurements are compared
  bool exact_if_possible = false;  // if there is an exact solution, use it instead of an integration
  bool at_probes = false;          // measure errors at the probes only, because the reference has another mesh
  std::vector<std::string> quantities = {};  // quantities whose errors are measured too
  std::string code;                          // fingerprint of the program that must do the work
};

Json to_json(const MeasurementInput& input);
MeasurementInput measurement_input_from(const Json& json);

struct ModelSize {
  std::size_t unknowns = 0, elements = 0, nodes = 0;
  double start = 0, end = 0;  // of the integration, s
  int order = 1;              // of the elements
};

struct Spread {
  double median = 0, min = 0, max = 0;
};

// Precondition: `values` is not empty.
Spread spread(std::vector<double> values);

// Largest change of the energy balance, relative to the largest kinetic or elastic energy E, and of the momenta,
// relative to sqrt(2 m E) and to d/2 sqrt(2 m E), where m is the mass and d the diagonal of the bounding box. Momenta
// are NaN unless the body is free of supports, loads and mass damping.
struct Drift {
  double energy = 0, linear_momentum = 0, angular_momentum = 0;
};

struct EnergyChange {
  std::vector<double> times, changes;  // s; change of the energy balance, relative to the largest energy
};

// Result of a measurement. After a failure, it holds all that was known by then.
struct MeasurementResult {
  enum class Kind { exact, computed };

  std::optional<Failure> failure;           // empty if completed
  std::optional<double> time_reached;       // by the last run, s
  std::optional<std::size_t> repeats;       // number of timed runs
  std::optional<Spread> wall, cpu;          // of the timed runs, s
  std::optional<Statistics> statistics;     // of the run with the median wall time
  std::optional<double> peak_memory;        // bytes, of all ranks
  std::optional<std::size_t> factor_bytes;  // Integrator::factor_bytes()
  std::optional<TrajectoryErrors> errors;   // against the reference
  std::optional<Drift> drift;
  std::optional<EnergyChange> drift_over_time;
  std::optional<double> smallest_det_f;         // smallest det F of all elements and steps; NaN if unknown
  std::optional<Named<std::string>> decisions;  // by the integrator, for keys that the input left open

  std::optional<ModelSize> model;
  std::optional<Kind> kind;
  std::optional<TrajectoryErrors> own_errors;  // round-off of an exact solution
  std::optional<double> mesh_error;            // MeshError::relative, of a reference
  std::optional<double> seconds;               // wall time of a run without timed repeats
  std::optional<TrajectoryScales> scales;
  std::string at;  // end of the measurement: 2026-01-31T12:00:00Z
};

// The members of a result that compare.json shows for each point. Those with a heading are also columns of compare.csv.
const JsonFields<MeasurementResult>& point_fields();

// Members without a value have no key in the JSON object.
Json to_json(const MeasurementResult& result);
MeasurementResult measurement_from(const Json& json);

Json to_json(const TrajectoryErrors& errors);
Json to_json(const TrajectoryScales& scales);

}  // namespace orthodyn::study::compare
