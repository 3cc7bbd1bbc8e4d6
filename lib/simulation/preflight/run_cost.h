// What a run of a scene will take of the processor, from the measured cost of a force, a tangent, a factorisation, a
// row of its tables and a frame.
// The number of steps is known for fixed steps and about known for explicit methods; of methods that choose their steps
// there is a range, by the motion's phase over the time span, which is right to an order of magnitude; it is wider
// where a body may touch something, and where an event may end the run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/preflight/scene_cost.h"

namespace orthodyn {

struct CostRange {
  double least = 0, most = 0;
};

struct RunCost {
  double force = 0, tangent = 0;                    // s, of one evaluation
  std::optional<double> factor = {}, solve = {};    // s; none for methods without a factor, and where it is too large
  CostRange step;                                   // s
  CostRange steps;                                  // equal where they are known
  bool fixed_steps = false;                         // by the input
  bool has_contact = false, may_end_early = false;  // error control meets a ground; an event may end the run
  double row = 0, frame = 0;                        // s, of one: what is computed of a state for it
  CostRange rows;                                   // each step where their number is not known
  double frames = 0;
  CostRange outputs() const { return {rows.least * row + frames * frame, rows.most * row + frames * frame}; }
  CostRange seconds() const {
    return {steps.least * step.least + outputs().least, steps.most * step.most + outputs().most};
  }
};

// Of an analysis whose integrator, if it has one, has been started; takes as long as a factorisation, at most some ten
// seconds.
RunCost run_cost(const Setup& setup, const std::vector<TermCost>& costs);

// Whether the integrator made from `config`, a scene, is `modal` or `auto` with that choice.
bool takes_modes(const Integrator& integrator, const Config& config);

// "2 to 40 min"; of ends far apart "0.3 s to 40 min".
std::string shown_seconds(const CostRange& range);

}  // namespace orthodyn
