// Expectations that all integrators miss in the same way: then the expectation, not the integrators, is in doubt.
#pragma once

#include <string>
#include <vector>

#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::stability {

struct Suspicion {
  std::string hard_case, variant, metric;
  std::size_t integrators = 0;     // that came to the end
  double lowest = 0, highest = 0;  // computed
  double expected = 0;
};

// One sentence for people.
std::string describe(const Suspicion& suspicion);

// Of the trials of a matrix, as in stability.json. A case is suspected in a variant if at least two integrators came to
// the end, none passes, all are farthest off in the same metric, and what they computed lies within that metric's limit
// of each other. Cases whose `model` says why are left out.
std::vector<Suspicion> suspected_expectations(const Json& cases, const Json& trials);

}  // namespace orthodyn::study::stability
