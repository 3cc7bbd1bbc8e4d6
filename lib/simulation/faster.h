// A faster way to the same motion: linear kinematics where they are accurate enough, and the method that `auto` takes
// then, modes where they serve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run_cost.h"

namespace orthodyn {

struct FasterWay {
  std::vector<std::string> changes;  // "elasticity.kinematics: linear", of the scene
  std::string method;                // that `auto` takes: "modal, 40 modes"
  double now = 0, then = 0;          // s, of the run as it is and with the changes, about
  // By which linear kinematics would be off, of the motion, about; none where the scene has them already.
  std::optional<double> error = {};
};

// Of a dynamic scene; makes its model, modes and costs anew. None where nothing saves half of the time, where linear
// kinematics would be off by more than 0.02, and for models of more than 30,000 unknowns.
std::optional<FasterWay> faster_way(const Setup& setup, const RunCost& cost);

}  // namespace orthodyn
