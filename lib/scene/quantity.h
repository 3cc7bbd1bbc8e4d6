// A figure of a state, by name:
//
//   PROBE.FIELD[.COMPONENT]              a field at a probe's node: tip.displacement.z, tip.nodal_stress_material.11
//   NAME[.COMPONENT]                     a scalar of the whole body: energy.kinetic, momentum.angular.y
//   [REGION.]FIELD[.COMPONENT].largest   the extreme of a field of stress or strain over the nodes of the body or of
//   one [REGION.]FIELD[.COMPONENT].smallest  region: von_mises.largest, grip.nodal_stress_material.22.largest
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/scene/scene.h"

namespace orthodyn {

class FemModel;

// The total energy with what was dissipated and less the work of loads: known to an EnergyMeter only.
inline constexpr const char* kEnergyBalance = "energy.balance";

struct Quantity {
  std::string name, unit;
  std::vector<std::string> choices = {};  // components of which none was chosen; then there are as many values
  std::function<std::vector<double>(const ObservedState&)> values = {};  // empty for kEnergyBalance

  int components() const { return choices.empty() ? 1 : static_cast<int>(choices.size()); }
  // A vector as a whole, of whose drift there is a size.
  bool is_vector() const { return choices.size() == 3; }
  // "'tip.displacement' has several components: choose .x, .y, .z or .magnitude"
  std::string ask_for_component() const;
};

// Throws ConfigError at `origin`.
Quantity find_quantity(const std::string& name, const Scene& scene, const FemModel& model,
                       const SourceLocation& origin);

// Of a quantity that ends on .largest or .smallest its value and the node where it is; NaN and -1 where no node has
// one.
struct Extreme {
  double value;
  int node;
};
using FindExtreme = std::function<Extreme(const ObservedState&)>;

// None for other quantities. Throws what require_strengths() does.
std::optional<FindExtreme> find_extreme(const std::string& name, const FemModel& model, const SourceLocation& origin);

// Throws ConfigError at `origin` for a field that needs strengths which no material of the region, or of the body where
// it is "", has.
void require_strengths(const std::string& field, const std::string& region, const FemModel& model,
                       const SourceLocation& origin);

// The same for a node, of which a region with strengths must be; of REGION.FIELD that very region.
void require_field_at(const std::string& field, int node, const FemModel& model, const SourceLocation& origin);

// The SI unit of such a quantity; "" for a plain number.
std::string unit_of_extreme(const std::string& name);

}  // namespace orthodyn
