// Proposes a faster set-up of a scene: linear kinematics if they are accurate enough, and the integrator that `auto`
// then chooses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/preflight/run_cost.h"

namespace orthodyn {

struct FasterSetup {
  std::vector<std::string> changes;  // of the scene: "elasticity.kinematics: linear"
  std::string method;                // chosen by `auto` after the changes: "modal, 40 modes"
  double now = 0, then = 0;          // estimated time of the run without and with the changes, s
  std::optional<double> error = {};  // relative error by linear kinematics; empty if the scene already has them

  // True if the run takes at most a third of the time and the error is at most 0.02.
  bool pays() const;
};

// Builds the scene of `setup` with these changes, lets `auto` choose a method, and measures the cost of the terms.
// Returns the result whether or not it is worthwhile. Empty for static scenes, for `kinematics: auto`, for warped
// corotation, if there is nothing to change, if the changed scene is not linear or cannot be set up, and above 30,000
// unknowns. `cost`: cost of the run of `setup`.
std::optional<FasterSetup> faster_setup(const Setup& setup, const RunCost& cost);

// Estimated relative error of the motion due to the linear kinematics of the scene of `linear`: the error at the
// largest displacement under its loads, plus the error that accumulates in a vibration of half that amplitude. Infinite
// if the body does not start at rest in its rest shape, if supports move, or if no linear response is known.
double error_of_linear_kinematics(const Setup& linear);

}  // namespace orthodyn
