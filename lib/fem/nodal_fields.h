// Fields at the nodes that derive from recovered stress and strain tensors (stress_recovery.h): invariants and failure
// criteria. Each region is evaluated with its own material; a node of several regions takes the largest value. A ply
// counts as a region: the values at its own bottom, middle and top are listed at the bottom, middle and top nodes of
// the cell. For the whole body, a tensor at a node is the mean over the regions and plies that contain it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/fem/stress_recovery.h"
#include "lib/ode/output.h"

namespace orthodyn {

// A field of symmetric tensors, with components in the order 11, 22, 33, 12, 23, 31.
struct TensorField {
  const char *name, *unit, *sentence;
  std::vector<std::string> components;
  Mat3 (*pick)(const PointObservation&);
  bool in_space = false;  // components along the space axes; otherwise along the material axes

  Vec6 operator()(const PointObservation& o) const {
    const Mat3 s = pick(o);
    return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
  }
};

// The fields strain (material axes), strain_space, stress (space axes) and stress_material.
const std::vector<TensorField>& tensor_fields();

// A field that is a function of one recovered tensor at a node.
struct DerivedField {
  const char *name, *unit, *sentence;
  const char* tensor;                   // name of a TensorField
  std::vector<std::string> components;  // empty for a scalar
  bool needs_strength;
  // One value per component; NaN if the region lacks a strength that the field needs.
  std::vector<double> (*of)(const Vec6&, const ElasticRegion&);
};

// The fields von_mises, principal_stress, principal_strain, nodal_det_f, max_stress, tsai_wu and hashin.
const std::vector<DerivedField>& derived_fields();

// The recovered tensors of one state, each computed at its first use and then kept. Not thread-safe.
class RecoveredTensors {
 public:
  // `recovery`, and the vectors that `s` refers to, must outlive this object.
  RecoveredTensors(const StressRecovery& recovery, const NodalState& s) : recovery_(recovery), state_(s) {}

  // Nodal values of the tensor in one region; the reference stays valid. Collective at the first use.
  const StressRecovery::NodalValues& of(const TensorField& tensor, std::size_t region);

  // The tensor at one node; empty if the region lacks the node. One rank evaluates only the elements around the
  // node, unless of() was called. Collective with several ranks.
  std::optional<StressRecovery::NodalValue> at(const TensorField& tensor, std::size_t region, int node);

  std::size_t num_nodes() const { return recovery_.num_nodes(); }
  std::size_t num_regions() const { return recovery_.num_regions(); }

 private:
  const StressRecovery& recovery_;
  NodalState state_;
  std::map<std::pair<const TensorField*, std::size_t>, StressRecovery::NodalValues> kept_;
  std::map<std::tuple<const TensorField*, std::size_t, int>, std::optional<StressRecovery::NodalValue>> kept_at_;
};

// The elastic terms (by index) over which a field is evaluated; empty for the whole body.
using FieldParts = std::vector<std::size_t>;

// Values at all nodes of the mesh, node by node; NaN outside the parts. At a node of several parts, a tensor is the
// mean and a derived field the largest value.
std::vector<double> tensor_at_nodes(RecoveredTensors& recovered, const TensorField& tensor, const FieldParts& parts);
std::vector<double> derived_at_nodes(RecoveredTensors& recovered, const StressRecovery::Terms& terms,
                                     const DerivedField& derived, const FieldParts& parts);

// The same at one node.
std::vector<double> tensor_at_node(RecoveredTensors& recovered, const TensorField& tensor, const FieldParts& parts,
                                   int node);
std::vector<double> derived_at_node(RecoveredTensors& recovered, const StressRecovery::Terms& terms,
                                    const DerivedField& derived, const FieldParts& parts, int node);

// A name that may stand before a field, as in NAME.FIELD: a region without plies, a ply, or the part of either that one
// elastic term computes.
struct FieldRegion {
  std::string name;
  FieldParts parts;
};

// All such names. The parts of a ply have different numbers on different meshes; the ply's name is valid on all.
std::vector<FieldRegion> field_regions(const StressRecovery::Terms& terms);

// The fields that are available for each region, as the output "REGION.FIELD".
std::vector<OutputInfo> region_fields();

}  // namespace orthodyn
