// Figures of stress and strain at the nodes, from the recovered tensors (stress_recovery.h): invariants, and how near a
// material is to failure. They are computed within each region, with its material; a node of several regions has the
// largest.
#pragma once

#include <string>
#include <vector>

#include "lib/fem/stress_recovery.h"
#include "lib/ode/output.h"

namespace orthodyn {

// 11, 22, 33, 12, 23, 31 of a symmetric tensor that is seen at a point.
struct SeenTensor {
  const char *name, *unit, *sentence;
  std::vector<std::string> components;
  Mat3 (*pick)(const PointObservation&);

  Vec6 operator()(const PointObservation& o) const {
    const Mat3 s = pick(o);
    return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
  }
};

// strain (material axes), strain_space, stress (space), stress_material.
const std::vector<SeenTensor>& seen_tensors();

// What is made of one of them at a node.
struct NodalFigure {
  const char *name, *unit, *sentence;
  const char* tensor;  // name of a SeenTensor
  std::vector<std::string> components;  // empty for a number
  bool needs_strength;
  // As many values as components, or one; NaN where the region has no strength and needs it.
  std::vector<double> (*of)(const Vec6&, const ElasticRegion&);
};

// von_mises, principal_stress, principal_strain, nodal_det_f, max_stress, tsai_wu, hashin.
const std::vector<NodalFigure>& nodal_figures();

// One value set per node of the mesh, NaN off the region. `region`: the index of an elastic term, or -1 for all.
std::vector<double> nodal_tensor(const StressRecovery& recovery, const NodalState& s, const SeenTensor& tensor, int region);
std::vector<double> nodal_figure(const StressRecovery& recovery, const StressRecovery::Terms& terms, const NodalState& s,
                                 const NodalFigure& figure, int region);

// The fields that can be asked for in one region, as "REGION.FIELD" of a state's view.
std::vector<OutputInfo> region_fields();

}  // namespace orthodyn
