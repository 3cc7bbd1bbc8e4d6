// The distance of a trajectory from a reference.
//
// Displacements u and velocities v are measured in the mass norm |u|_M = sqrt(u' M u), as the model's
// kinetic energy weighs them, relative to the largest |u_ref|_M and |v_ref|_M over the samples;
// probes by the length of their displacement relative to its largest length, quantities that are followed by their
// size relative to its largest. Other norms may take the place of the mass norm.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/simulation/error_estimate/trajectory.h"

namespace orthodyn {

struct ErrorNorms {
  double final = 0;  // at the end
  double l2 = 0;     // root of the mean square over the samples
  double max = 0;    // the worst sample
};

// A point whose displacement is followed: its three coordinates in q, -1 where clamped.
struct ProbePoint {
  std::string name;
  std::array<int, 3> dofs;
};

// A number, or a vector by its components: consecutive rows of Trajectory::quantities.
struct FollowedQuantity {
  std::string name;
  int components = 1;
};

struct TrajectoryErrors {
  ErrorNorms displacement, velocity;
  std::vector<std::pair<std::string, ErrorNorms>> probes, quantities;
  double phase = 0;  // rad, of the dominant frequency; NaN where there is none
};

struct TrajectoryScales {
  double displacement = 0, velocity = 0;                   // sqrt(kg) m, sqrt(kg) m/s
  std::vector<std::pair<std::string, double>> probes;      // m
  std::vector<std::pair<std::string, double>> quantities;  // in their SI units
  double dominant_frequency = 0;                           // Hz; NaN where there is none
};

// A reference, prepared for comparison with trajectories at the same times.
class ReferenceNorms {
 public:
  // Columns x as M x: |x| is the root of x' M x.
  using Metric = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& x)>;

  // In the mass norm, of trajectories of the whole model. `model` must outlive it; then all functions are collective.
  ReferenceNorms(const FemModel& model, Trajectory reference, std::vector<ProbePoint> probes,
                 std::vector<FollowedQuantity> quantities = {});
  // In another one.
  ReferenceNorms(Metric metric, Trajectory reference, std::vector<ProbePoint> probes,
                 std::vector<FollowedQuantity> quantities = {});

  const TrajectoryScales& scales() const { return scales_; }
  TrajectoryErrors errors(const Trajectory& trajectory) const;

 private:
  // |x| of each column.
  std::vector<double> norms(const Eigen::MatrixXd& x) const;
  Vector leading_mode() const;

  Metric metric_;
  Trajectory reference_;
  std::vector<ProbePoint> probes_;
  std::vector<FollowedQuantity> quantities_;
  TrajectoryScales scales_;
  Vector mode_;  // M times the leading mode; empty where nothing swings
};

}  // namespace orthodyn
