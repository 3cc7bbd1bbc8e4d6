// Fields of stress and strain at the nodes, from the recovered tensors (stress_recovery.h): invariants, and how near a
// material is to failure. They are computed within each region, with its material; a node of several regions has the
// largest.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/stress_recovery.h"
#include "lib/ode/output.h"

namespace orthodyn {

// A symmetric tensor of a point: 11, 22, 33, 12, 23, 31.
struct TensorField {
  const char *name, *unit, *sentence;
  std::vector<std::string> components;
  Mat3 (*pick)(const PointObservation&);

  Vec6 operator()(const PointObservation& o) const {
    const Mat3 s = pick(o);
    return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
  }
};

// strain (material axes), strain_space, stress (space), stress_material.
const std::vector<TensorField>& tensor_fields();

// What is made of one of them at a node.
struct DerivedField {
  const char *name, *unit, *sentence;
  const char* tensor;                   // name of a TensorField
  std::vector<std::string> components;  // empty for a number
  bool needs_strength;
  // As many values as components, or one; NaN where the region has no strength and needs it.
  std::vector<double> (*of)(const Vec6&, const ElasticRegion&);
};

// von_mises, principal_stress, principal_strain, nodal_det_f, max_stress, tsai_wu, hashin.
const std::vector<DerivedField>& derived_fields();

// The recovered tensors of one state: each is computed when it is first asked for, and kept for all fields that are
// made of it. Not thread-safe.
class RecoveredTensors {
 public:
  // Both must outlive it, and what the state refers to.
  RecoveredTensors(const StressRecovery& recovery, const NodalState& s) : recovery_(recovery), state_(s) {}

  // Of a region; valid as long as this. Collective where it is computed.
  const StressRecovery::OfRegion& of(const TensorField& tensor, std::size_t region);

  std::size_t num_nodes() const { return recovery_.num_nodes(); }
  std::size_t num_regions() const { return recovery_.num_regions(); }

 private:
  const StressRecovery& recovery_;
  NodalState state_;
  std::map<std::pair<const TensorField*, std::size_t>, StressRecovery::OfRegion> kept_;
};

// One value set per node of the mesh, NaN off the region. `region`: the index of an elastic term, or -1 for all: of a
// tensor then the mean of the regions of a node.
std::vector<double> tensor_at_nodes(RecoveredTensors& recovered, const TensorField& tensor, int region);
std::vector<double> derived_at_nodes(RecoveredTensors& recovered, const StressRecovery::Terms& terms,
                                     const DerivedField& derived, int region);

// The fields that can be asked for in one region, as "REGION.FIELD" of a state's view.
std::vector<OutputInfo> region_fields();

}  // namespace orthodyn
