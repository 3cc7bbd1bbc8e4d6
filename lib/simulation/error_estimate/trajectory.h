// States, and quantities that are followed, at chosen times: what errors are computed from.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct Trajectory {
  std::vector<double> times;
  Eigen::MatrixXd q, v;             // N x times
  Eigen::MatrixXd quantities = {};  // their components x times

  // Binary, whole or absent. Both throw RunError.
  void save(const std::filesystem::path& path) const;
  static Trajectory load(const std::filesystem::path& path);

  // True if the file is as it was written, by its fingerprint.
  static bool is_whole(const std::filesystem::path& path);
};

// Records the initial state and every output.
class TrajectoryRecorder : public Observer {
 public:
  explicit TrajectoryRecorder(std::size_t outputs, std::vector<Quantity> quantities = {})
      : outputs_(outputs), quantities_(std::move(quantities)) {}
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override;

  const Trajectory& trajectory() const { return trajectory_; }

 private:
  // What is kept of a state.
  virtual State state_of(const ObservedState& observed) const { return observed.state(); }

  std::size_t outputs_;
  std::vector<Quantity> quantities_;
  Trajectory trajectory_;
};

}  // namespace orthodyn
