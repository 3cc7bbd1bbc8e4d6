// The part of `orthodyn check` that predicts time, disk and memory of a run.
#pragma once

#include "lib/simulation/run/setup.h"

namespace orthodyn {

// Measures the terms of the scene for about a second. Prints the predicted time and disk usage of the run, a faster
// setup if there is one, and terms that could be left out. The faster setup is sought only with `has_time`: the scene
// has a time span.
void print_predicted_cost(const Setup& setup, bool has_time);

// Warns on stderr if the integrator's factorisation needs more memory than is available.
void warn_of_memory(const Setup& setup);

}  // namespace orthodyn
