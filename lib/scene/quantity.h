// A quantity of a state, by name:
//
//   PROBE.FIELD[.COMPONENT]              a field at a probe's node: tip.displacement.z, tip.nodal_stress_material.11
//   GAUGE.length, GAUGE.strain            of a strain gauge (lib/scene/gauge.h)
//   NAME[.COMPONENT]                     a quantity of the whole body: energy.kinetic, momentum.angular.y
//   [REGION.]FIELD[.COMPONENT].largest   the largest (or .smallest) value of a stress or strain field over the nodes of
//                                        the body, a region or a ply: von_mises.largest, grip.nodal_stress.xx.smallest
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/scene/scene.h"

namespace orthodyn {

class FemModel;

// Total energy plus dissipated energy minus work of loads. Only an EnergyMeter computes it.
inline constexpr const char* kEnergyBalance = "energy.balance";

struct Quantity {
  std::string name, unit;
  std::vector<std::string> choices = {};  // the components, if none was chosen; `values` then returns all
  std::function<std::vector<double>(const ObservedState&)> values = {};  // empty for kEnergyBalance
  // The values in a model whose nodes may have other places, for gauges; empty if `values` are the same.
  std::function<std::vector<double>(const ObservedState&, const Mesh&)> values_on = {};

  int components() const { return choices.empty() ? 1 : static_cast<int>(choices.size()); }
  // True for three components, also principal stresses; the norm then measures the drift.
  bool is_vector() const { return choices.size() == 3; }
  // "'tip.displacement' has several components: choose .x, .y, .z or .magnitude"
  std::string ask_for_component() const;
};

// Throws ConfigError at `origin` if the scene has no such quantity.
Quantity find_quantity(const std::string& name, const Scene& scene, const FemModel& model,
                       const SourceLocation& origin);

// Value and node of an extreme; NaN and -1 if no node has a value.
struct Extreme {
  double value;
  int node;       // -1 if there is no value
  int term = -1;  // index of the elastic term (region or ply); -1 if the model has only one
};
using FindExtreme = std::function<Extreme(const ObservedState&)>;

// Makes the function that finds the extreme; nullopt if the name is not an extreme. Throws like require_strengths().
std::optional<FindExtreme> find_extreme(const std::string& name, const FemModel& model, const SourceLocation& origin);

// Throws ConfigError at `origin` if the field needs strengths, but no material of the region (of the body if "") has
// them.
void require_strengths(const std::string& field, const std::string& region, const FemModel& model,
                       const SourceLocation& origin);

// Likewise for a field at a node: one of the node's regions must have strengths. The region of REGION.FIELD must
// contain the node, and only its strengths count.
void require_field_at(const std::string& field, int node, const FemModel& model, const SourceLocation& origin);

// SI unit of an extreme; "" if dimensionless.
std::string unit_of_extreme(const std::string& name);

}  // namespace orthodyn
