// A figure of a state, by name: a probe's field ("tip.displacement.z", "tip.velocity.magnitude") or a
// scalar of the whole body ("energy.kinetic", "momentum.angular.y", "det_f.smallest").
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/scene/scene.h"

namespace orthodyn {

class FemModel;

// The total energy with what was dissipated and less the work of loads: known to an EnergyMeter only.
inline constexpr const char* kEnergyBalance = "energy.balance";

struct Quantity {
  std::string name, unit;
  int components = 1;  // 3 where none was chosen of a vector
  std::function<std::vector<double>(const ObservedState&)> values;  // empty for kEnergyBalance
};

// Throws ConfigError at `origin`.
Quantity find_quantity(const std::string& name, const Scene& scene, const FemModel& model, const Origin& origin);

}  // namespace orthodyn
