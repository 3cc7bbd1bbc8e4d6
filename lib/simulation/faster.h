// A faster way to the same motion: linear kinematics where they are accurate enough, and the method that `auto` takes
// then, modes where they serve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run_cost.h"

namespace orthodyn {

struct FasterWay {
  std::vector<std::string> changes;  // of the scene: "elasticity.kinematics: linear"
  std::string method;                // which `auto` takes then: "modal, 40 modes"
  double now = 0, then = 0;          // s, of the run as it is and with the changes, about
  // Error of the motion by linear kinematics, relative, about; none where the scene has them already.
  std::optional<double> error = {};

  // Whether it is worth a word: it takes a third of the time at most and costs less than 0.02 of the motion.
  bool pays() const;
};

// The changes that `setup`, a dynamic scene, allows, whether they pay or not; `cost` is that of its run. Builds the changed
// scene, chooses its method and measures its terms. None where there is nothing to change, where the changed scene is not
// linear or cannot be set up, and for models of more than 30,000 unknowns.
std::optional<FasterWay> faster_way(const Setup& setup, const RunCost& cost);

// Error of the motion, relative, about, if a scene with linear kinematics had corotational ones: at the largest displacement
// that its loads reach, and what adds up in vibrations about half of that. Infinite where the motion is not that of loads
// on a body at rest, or no linear response is known.
double error_of_linear_kinematics(const Setup& linear);

}  // namespace orthodyn
