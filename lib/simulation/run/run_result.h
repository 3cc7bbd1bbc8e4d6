// What came out of a run of a scene: the values that run.json and the program's summary are written from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/ode/statistics.h"
#include "lib/simulation/checkpoint/effort.h"
#include "lib/simulation/error_estimate/accumulated_error.h"
#include "lib/simulation/error_estimate/error_estimate.h"
#include "lib/simulation/error_estimate/mesh_error.h"
#include "lib/simulation/output/balance.h"
#include "lib/simulation/output/extremes.h"
#include "lib/simulation/output/strain_watch.h"
#include "lib/simulation/run/kinematics.h"
#include "lib/simulation/run/outcome.h"
#include "lib/statics/critical_point.h"

namespace orthodyn {

struct ModelSummary {
  std::size_t nodes = 0, elements = 0;
  int unknowns = 0;
  int order = 1;                   // of its elements
  std::string elasticity;          // the laws of its regions
  std::vector<std::string> terms;  // in words
  std::string kinematics = {};     // what was taken for `auto`, and why, and how far linear kinematics are off; or ""
  std::optional<double> linear_error = {};  // of these, of the motion; infinite where it is a good part
  bool buckles = false;                     // below loads that linear kinematics carry
};

struct EnergySummary {
  EnergyBalance last;           // J
  double time = 0;              // of that, s
  double drift = 0, scale = 0;  // J: of the balance, and the largest energy
  double relative_drift = 0;
  EnergyTimes times = EnergyTimes::outputs;  // of which the drift is the largest
  std::size_t states = 0;                    // how many these are
};

struct MomentumSummary {
  double angular_drift = 0, angular_scale = 0;  // kg m^2/s
};

// The smallest det F: an element with det F <= 0 is inverted.
struct SmallestDetF {
  double value = 1;
  long element = -1;
  double time = 0;  // s
};

// Where a run failed: the places that are likely to be at fault.
struct FailurePlace {
  double smallest_det_f = 0, largest_speed = 0;  // -, m/s
  long element = 0, node = 0;
};

// Of a dynamic analysis.
struct MotionResult {
  std::string integrator = {};                                      // its type
  std::vector<std::pair<std::string, std::string>> decisions = {};  // of the integrator: key and value
  std::vector<std::string> warnings = {};                           // of the integrator
  Effort effort = {};                                               // over all restarts
  std::size_t factor_bytes = 0;
  SmallestDetF det_f = {};
  std::optional<EnergySummary> energy = {};          // where the scene asks for energy.csv
  std::optional<MomentumSummary> momentum = {};      // likewise momentum.csv
  std::optional<FailurePlace> failure = {};          // of a run that failed
  std::optional<AccumulatedError> accumulated = {};  // of a long run
  std::optional<ErrorEstimate> error = {};           // if it was asked for
  std::optional<MeshError> mesh_error = {};          // of a body that is deformed
  std::optional<double> rtol = {};                   // of the integrator
  std::vector<std::string> silent_events = {};       // that were asked for and never happened
};

// Where a probe's node has gone, m, and how far the mesh puts that off: true less computed.
struct ProbedDisplacement {
  std::string probe;
  Vec3 value, mesh_error;  // m; NaN where the latter is not known
};

// Of a static analysis: the last equilibrium.
struct EquilibriumResult {
  double loads_at_time = 0;  // s
  long load_steps = 0, rejected_load_steps = 0;
  long jumps = 0;  // down the energy to another path
  std::vector<CriticalPoint> critical_points = {};
  std::optional<int> unstable = {};       // directions in which it is unstable; none: not known
  bool unsymmetric = false;               // K is: critical points are where its determinant changes its sign
  double largest_displacement = 0;        // m, of a coordinate
  double residual = 0, largest_load = 0;  // N, of a coordinate
  bool residual_above_tolerance = false;
  std::string solver = {};  // its linear solver
  Statistics statistics = {};
  SmallestDetF det_f = {};
  std::optional<MeshError> mesh_error = {};
  std::vector<ProbedDisplacement> probes = {};  // of each probe
};

// Of a buckling analysis, the lowest load factor first.
struct BucklingResult {
  double loads_at_time = 0;  // s
  int wanted = 0;            // modes that were asked for
  double limit = 0;          // load factor above which no mode is told: linear statics reach a strain of a tenth
  bool unsymmetric = false;  // the stiffness of a load is, and its symmetric part was taken
  struct Mode {
    double load_factor = 0, residual = 0;
    double mesh_error = 0;  // the share by which the mesh makes the factor too high, estimated
  };
  std::vector<Mode> modes = {};
};

struct RunResult {
  std::string scene;  // its file
  std::filesystem::path folder;
  Outcome outcome = {};
  ModelSummary model = {};
  std::optional<MotionResult> motion = {};  // one of these,
  std::optional<EquilibriumResult> equilibrium = {};
  std::optional<BucklingResult> buckling = {};  // or none where nothing was to be done
  std::vector<RecordedExtreme> extremes = {};
  std::optional<PassedStrain> passed_strain = {};  // where the law's limit was passed
  bool was_complete = false;                       // it was to be resumed, and had reached its end before
  std::optional<Outgrown> outgrown = {};           // why it ended, and is to start again
  int ranks = 1;                                   // that have computed it together
  bool resumable = false;                          // the folder holds a checkpoint of a late state
  bool failed_alone = false;                       // one of several ranks: the others do not know, and wait for it
};

}  // namespace orthodyn
