// States as they are where one process holds the model: by them trajectories of several ranks are compared. All
// functions are collective.
#pragma once

#include <array>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/simulation/error_estimate/trajectory.h"

namespace orthodyn {

class WholeRecorder : public TrajectoryRecorder {
 public:
  // `model` must outlive it.
  WholeRecorder(const FemModel& model, std::size_t outputs, std::vector<Quantity> quantities)
      : TrajectoryRecorder(outputs, std::move(quantities)), model_(model) {}

 private:
  State state_of(const ObservedState& observed) const override { return model_.whole(observed.state()); }

  const FemModel& model_;
};

// The unknowns of a node of the mesh, -1 where clamped.
std::array<int, 3> unknowns_of(const FemModel& model, int node);

// M x of each column.
Eigen::MatrixXd times_mass(const FemModel& model, const Eigen::MatrixXd& x);

}  // namespace orthodyn
