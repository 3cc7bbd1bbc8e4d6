// The result of a run: source of run.json and of the program's summary.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/ode/statistics.h"
#include "lib/simulation/checkpoint/total_cost.h"
#include "lib/simulation/error_estimate/error_estimate.h"
#include "lib/simulation/error_estimate/linearity_watch.h"
#include "lib/simulation/error_estimate/mesh_error.h"
#include "lib/simulation/error_estimate/segment_error_estimate.h"
#include "lib/simulation/output/balance.h"
#include "lib/simulation/output/contact_watch.h"
#include "lib/simulation/output/extremes.h"
#include "lib/simulation/output/joint_watch.h"
#include "lib/simulation/output/strain_watch.h"
#include "lib/simulation/run/outcome.h"
#include "lib/statics/critical_point.h"

namespace orthodyn {

struct ModelSummary {
  std::size_t nodes = 0, elements = 0;
  int unknowns = 0;
  int order = 1;                   // of the elements
  std::string elasticity;          // the laws of the regions
  std::vector<std::string> terms;  // descriptions
  std::string kinematics = {};     // kinematics_summary(): choice for `auto`, and the error of linear kinematics; or ""
  std::optional<double> linear_error = {};  // relative error of linear kinematics; infinite if too large to estimate
  bool buckles = false;                     // true if the body buckles below loads that linear kinematics carry
  bool has_barrier = false;                 // contact by a barrier
};

struct EnergySummary {
  EnergyBalance last;           // J
  double time = 0;              // of `last`, s
  double drift = 0, scale = 0;  // largest |change| of the balance; largest energy; J
  double relative_drift = 0;
  EnergyTimes times = EnergyTimes::outputs;  // times at which the drift was evaluated
  std::size_t states = 0;                    // number of these times
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

// Places where the cause of a failure is likely: the element with the smallest det F, and the fastest node.
struct FailurePlace {
  double smallest_det_f = 0, largest_speed = 0;  // -, m/s
  long element = 0, node = 0;
};

// Result of a dynamic analysis.
struct MotionResult {
  std::string integrator = {};                                      // its `type`
  std::vector<std::pair<std::string, std::string>> decisions = {};  // of the integrator: key and value
  std::vector<std::string> warnings = {};                           // of the integrator
  TotalCost cost = {};                                              // over all restarts
  std::size_t factor_bytes = 0;
  SmallestDetF det_f = {};
  std::optional<EnergySummary> energy = {};                // if the scene writes energy.csv
  std::optional<MomentumSummary> momentum = {};            // if the scene writes momentum.csv
  std::optional<JointErrors> joints = {};                  // if the scene has joints
  double joints_extent = 0;                                // of the mesh, m
  std::optional<ContactRecord> contacts = {};              // if the scene has contact
  std::optional<FailurePlace> failure = {};                // of a failed run
  std::optional<SegmentErrorEstimate> segment_error = {};  // of a long run
  std::optional<ErrorEstimate> error = {};                 // if requested
  std::optional<MeshError> mesh_error = {};                // if the body is deformed
  std::optional<double> rtol = {};                         // of the integrator
  std::vector<std::string> events_not_found = {};          // events of the scene that never occurred
};

// Displacement of a probe's node, and its error due to the mesh (exact less computed).
struct ProbedDisplacement {
  std::string probe;
  Vec3 value, mesh_error;  // m; mesh_error is NaN if unknown
};

// Result of a static analysis: the last equilibrium.
struct EquilibriumResult {
  double loads_at_time = 0;  // s
  long load_steps = 0, rejected_load_steps = 0;
  long jumps = 0;  // dynamic jumps to another equilibrium path with less energy
  std::vector<CriticalPoint> critical_points = {};
  std::optional<int> unstable = {};  // number of unstable directions; empty if unknown
  bool unsymmetric = false;          // stiffness is unsymmetric: critical points are sign changes of its determinant
  double largest_displacement = 0;   // of a coordinate, m
  double residual = 0, largest_load = 0;  // of a coordinate, N
  bool residual_above_tolerance = false;
  std::string solver = {};  // the linear solver
  Statistics statistics = {};
  SmallestDetF det_f = {};
  std::optional<MeshError> mesh_error = {};
  std::vector<ProbedDisplacement> probes = {};
};

// Result of a buckling analysis; lowest load factor first.
struct BucklingResult {
  double loads_at_time = 0;  // s
  int wanted = 0;            // requested modes
  double limit = 0;          // largest load factor reported, at which linear statics reach a strain of 0.1
  bool unsymmetric = false;  // true if the stiffness of a load is unsymmetric; its symmetric part was used
  struct Mode {
    double load_factor = 0, residual = 0;
    double mesh_error = 0;  // estimated relative error of the load factor due to the mesh; positive if it is too high
  };
  std::vector<Mode> modes = {};
};

// Result of a harmonic analysis.
struct HarmonicResult {
  bool is_loaded = false;  // the body vibrates about the equilibrium under steady loads
  std::size_t frequencies = 0;
  double lowest = 0, highest = 0;  // Hz
  struct Mode {
    double frequency = 0, damping_ratio = 0;  // Hz, -
    double mesh_error = 0;                    // estimated relative error of the frequency; positive if it is too high
  };
  std::vector<Mode> modes = {};  // up to the highest frequency
  // Largest amplitude of each quantity.
  struct Peak {
    std::string quantity, unit;
    double frequency = 0, amplitude = 0;
  };
  std::vector<Peak> peaks = {};
  long basis = 0;                // number of vectors
  double error = 0, rtol = 0;    // estimated relative error of the amplitudes for this mesh, and the requested one
  std::vector<int> missed = {};  // modes whose resonance can lie between two frequencies
  bool stagnated = false;        // further vectors did not reduce the error
  std::vector<std::string> warnings = {};  // of the set-up and the mesh
};

struct RunResult {
  std::string scene;  // file name
  std::filesystem::path folder;
  Outcome outcome = {};
  ModelSummary model = {};
  std::optional<MotionResult> motion = {};  // one of the four is set; none if already complete
  std::optional<EquilibriumResult> equilibrium = {};
  std::optional<BucklingResult> buckling = {};
  std::optional<HarmonicResult> harmonic = {};
  std::vector<RecordedExtreme> extremes = {};
  std::optional<ExceededStrain> exceeded_strain = {};        // if the strain limit of the law was exceeded
  bool was_complete = false;                                 // the run to be resumed was already complete
  std::optional<KinematicsRestart> kinematics_restart = {};  // the run ended and must be repeated with other kinematics
  int ranks = 1;                                             // number of ranks that computed the scene
  bool resumable = false;                                    // the folder holds a checkpoint
  bool only_this_rank_failed = false;                        // only this rank failed; the others wait for it
};

}  // namespace orthodyn
