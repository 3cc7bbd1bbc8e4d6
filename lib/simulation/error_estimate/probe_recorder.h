// The motion of probes, for the comparison of runs on different meshes: each is followed at the place that the scene
// gives, within its element, not at the nearest node.
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/mesh_point.h"
#include "lib/scene/scene.h"
#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/simulation/error_estimate/trajectory.h"

namespace orthodyn {

// Records displacements as q and velocities as v: three rows a probe, in the order of the scene.
class ProbeRecorder : public TrajectoryRecorder {
 public:
  ProbeRecorder(const Named<Probe>& probes, const TetMesh& mesh, std::size_t outputs, std::vector<Quantity> quantities);

 private:
  State state_of(const ObservedState& observed) const override;
  Vector at_probes(const std::vector<double>& nodal) const;

  std::vector<MeshPoint> places_;
};

// Distances from what was recorded of these probes: the root mean square over the probes takes the place of the mass
// norm.
ReferenceNorms probe_norms(Trajectory reference, const Named<Probe>& probes, std::vector<FollowedQuantity> quantities);

}  // namespace orthodyn
