// Errors of a trajectory: its differences from a reference trajectory at the same times.
//
// With the mass norm |u|_M = sqrt(u^T M u), the displacement error is |u - u_ref|_M relative to the largest |u_ref|_M
// of the samples, and the velocity error likewise. Error of a probe: length of the difference of its displacements,
// relative to the largest length of the reference. Error of another quantity: norm of the difference, relative to the
// largest norm of the reference. Another matrix may replace M. Errors are NaN if the reference is zero.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/scene/scene.h"
#include "lib/simulation/error_estimate/trajectory.h"

namespace orthodyn {

struct ErrorNorms {
  double final = 0;  // at the end
  double l2 = 0;     // root mean square over the samples
  double max = 0;    // largest over the samples
};

// A point whose displacement is compared. `dofs`: indices of its three coordinates in q, -1 where clamped.
struct ProbePoint {
  std::string name;
  std::array<int, 3> dofs;
};

// A scalar or vector quantity, stored in consecutive rows of Trajectory::quantities.
struct FollowedQuantity {
  std::string name;
  int components = 1;
};

struct TrajectoryErrors {
  ErrorNorms displacement, velocity;
  std::vector<std::pair<std::string, ErrorNorms>> probes, quantities;
  double phase = 0;  // phase error at the dominant frequency, rad; NaN if there is none
};

// Largest values of the reference over the samples.
struct TrajectoryScales {
  double displacement = 0, velocity = 0;                   // sqrt(kg) m, sqrt(kg) m/s
  std::vector<std::pair<std::string, double>> probes;      // m
  std::vector<std::pair<std::string, double>> quantities;  // in their SI units
  double dominant_frequency = 0;                           // Hz; NaN if there is none
};

// A reference trajectory, prepared for comparison with trajectories at the same times.
class ReferenceNorms {
 public:
  // Returns M x for each column of x.
  using Metric = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& x)>;

  // Uses the mass norm. Trajectories contain all unknowns of the whole model. `model` must outlive the object. All
  // functions are collective.
  ReferenceNorms(const FemModel& model, Trajectory reference, std::vector<ProbePoint> probes,
                 std::vector<FollowedQuantity> quantities = {});
  // Uses the norm sqrt(x^T metric(x)).
  ReferenceNorms(Metric metric, Trajectory reference, std::vector<ProbePoint> probes,
                 std::vector<FollowedQuantity> quantities = {});

  const TrajectoryScales& scales() const { return scales_; }
  TrajectoryErrors errors(const Trajectory& trajectory) const;

 private:
  // Norm of each column.
  std::vector<double> norms(const Eigen::MatrixXd& x) const;
  // M times the first proper orthogonal mode of the reference.
  Vector leading_mode() const;

  Metric metric_;
  Trajectory reference_;
  std::vector<ProbePoint> probes_;
  std::vector<FollowedQuantity> quantities_;
  TrajectoryScales scales_;
  Vector mode_;  // M times the leading mode; empty if no frequency dominates
};

// Errors of trajectories recorded at these probes (ProbeRecorder). The root mean square over the probes replaces the
// mass norm.
ReferenceNorms probe_norms(Trajectory reference, const Named<Probe>& probes, std::vector<FollowedQuantity> quantities);

}  // namespace orthodyn
