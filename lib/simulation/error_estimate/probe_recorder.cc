#include "lib/simulation/error_estimate/probe_recorder.h"

namespace orthodyn {

ProbeRecorder::ProbeRecorder(const Named<Probe>& probes, const TetMesh& mesh, std::size_t outputs,
                             std::vector<Quantity> quantities)
    : TrajectoryRecorder(outputs, std::move(quantities)) {
  for (const auto& [name, probe] : probes) places_.push_back(mesh_point(mesh, probe.at));
}

State ProbeRecorder::state_of(const ObservedState& observed) const {
  return {observed.t(), at_probes(observed.evaluate("displacement")), at_probes(observed.evaluate("velocity"))};
}

Vector ProbeRecorder::at_probes(const std::vector<double>& nodal) const {
  Vector all = Vector::Zero(3 * static_cast<Eigen::Index>(places_.size()));
  Eigen::Index row = 0;
  for (const auto& place : places_) {
    for (const auto& [node, weight] : place.nodes)
      all.segment<3>(row) += weight * Eigen::Map<const Vec3>(nodal.data() + 3 * static_cast<std::ptrdiff_t>(node));
    row += 3;
  }
  return all;
}

ReferenceNorms probe_norms(Trajectory reference, const Named<Probe>& probes, std::vector<FollowedQuantity> quantities) {
  std::vector<ProbePoint> points;
  for (const auto& [name, probe] : probes) {
    const int first = 3 * static_cast<int>(points.size());
    points.push_back({name, {first, first + 1, first + 2}});
  }
  const double share = 1 / static_cast<double>(points.size());
  const auto mean = [share](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return share * x; };
  return {mean, std::move(reference), points, std::move(quantities)};
}

}  // namespace orthodyn
