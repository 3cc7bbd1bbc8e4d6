// Estimates the processor time of a run before it starts, from the measured time of a force, a tangent, a
// factorisation, a table row and a frame. The number of steps is exact for fixed steps and approximate for explicit
// methods. For methods with adaptive steps it is a range, accurate to an order of magnitude, derived from the phase
// angle of the motion over the time span. The range is wider if the body may come into contact or an event may end the
// run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/preflight/scene_cost.h"

namespace orthodyn {

struct CostRange {
  double least = 0, most = 0;
};

struct RunCost {
  double force = 0, tangent = 0;  // one evaluation, s
  std::optional<double> factor = {},
                        solve = {};  // s; empty if the method has no factorisation or it is too large to measure
  CostRange step;                    // one step, s
  CostRange steps;                   // equal limits if the number is known
  bool fixed_steps = false;          // step size given in the input
  bool has_contact = false, may_end_early = false;  // adaptive steps with contact; an event may end the run
  bool may_creep = false;     // adaptive steps, which become long if loads and relaxation are slower than vibrations
  double row = 0, frame = 0;  // time to compute one table row, one frame, s
  CostRange rows;             // number of rows; one per step if unknown
  double frames = 0;
  CostRange outputs() const { return {rows.least * row + frames * frame, rows.most * row + frames * frame}; }
  CostRange seconds() const {
    return {steps.least * step.least + outputs().least, steps.most * step.most + outputs().most};
  }
};

// Call after the integrator, if any, has been started. Takes as long as a factorisation, at most about 10 s.
RunCost run_cost(const Setup& setup, const std::vector<TermCost>& costs);

// "2 to 40 min"; for a wide range "0.3 s to 40 min".
std::string shown_seconds(const CostRange& range);

}  // namespace orthodyn
