// Measures the cost of a scene's terms, and finds parts that are negligible at the scene's accuracy. Most parts are
// judged by linear static responses to the peak loads.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct TermCost {
  std::string name;
  double force = 0, tangent = 0;  // one evaluation, s
};

// Measures all terms at the initial state. Takes about `seconds`.
std::vector<TermCost> term_costs(const FemModel& model, const State& initial, double seconds);

// One sentence for each saving. If there is no static response, only the size of the frames is checked.
std::vector<std::string> possible_savings(const Setup& setup, const std::vector<TermCost>& costs);

// The accuracy at which parts are judged: integrator.rtol, or 1e-3 if absent.
double requested_accuracy(const Scene& scene);

}  // namespace orthodyn
