// Observers that record states for comparisons of runs: whole trajectories, the motion of probes, or one state.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/mesh/mesh_point.h"
#include "lib/scene/quantity.h"
#include "lib/scene/scene.h"
#include "lib/simulation/error_estimate/trajectory.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

// Records the initial state and every output.
class TrajectoryRecorder : public Observer {
 public:
  explicit TrajectoryRecorder(std::size_t outputs, std::vector<Quantity> quantities = {})
      : outputs_(outputs), quantities_(std::move(quantities)) {}
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override;

  const Trajectory& trajectory() const { return trajectory_; }

 private:
  // The part of a state that is recorded.
  virtual State state_of(const ObservedState& observed) const { return observed.state(); }

  std::size_t outputs_;
  std::vector<Quantity> quantities_;
  Trajectory trajectory_;
};

// Records global states of a model distributed over ranks, to compare runs on different numbers of ranks. Collective.
class GlobalTrajectoryRecorder : public TrajectoryRecorder {
 public:
  // `model` must outlive the recorder.
  GlobalTrajectoryRecorder(const FemModel& model, std::size_t outputs, std::vector<Quantity> quantities)
      : TrajectoryRecorder(outputs, std::move(quantities)), model_(model) {}

 private:
  State state_of(const ObservedState& observed) const override { return model_.whole(observed.state()); }

  const FemModel& model_;
};

// Indices of the global unknowns of a mesh node; -1 where clamped.
std::array<int, 3> global_dofs(const FemModel& model, int node);

// M x for each column of x, with the mass matrix M.
Eigen::MatrixXd global_mass_product(const FemModel& model, const Eigen::MatrixXd& x);

// Records displacements of probes as q and their velocities as v, to compare runs on different meshes. Each probe has
// three rows, in the order of the scene. Values are interpolated to the probe's position within an element, not taken
// from the nearest node.
class ProbeRecorder : public TrajectoryRecorder {
 public:
  ProbeRecorder(const Named<Probe>& probes, const Mesh& mesh, std::size_t outputs, std::vector<Quantity> quantities);

 private:
  State state_of(const ObservedState& observed) const override;
  Vector at_probes(const std::vector<double>& nodal) const;

  std::vector<MeshPoint> places_;
};

// Keeps the last state up to a given time.
class Snapshot : public Observer {
 public:
  // `at`: time, s; it must be an output time if it lies within the run. Empty: the end of the run.
  explicit Snapshot(std::optional<double> at) : at_(at) {}
  void on_start(const ObservedState& observed) override { state_ = observed.state(); }
  void on_output(const ObservedState& observed) override { keep(observed.state()); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { keep(observed.state()); }

  const State& state() const { return state_; }

 private:
  void keep(const State& s) {
    if ((!at_ || s.t <= *at_) && s.t > state_.t) state_ = s;
  }

  std::optional<double> at_;
  State state_;
};

}  // namespace orthodyn
