// What of a scene several ranks can do together.
#pragma once

#include "lib/config/config.h"
#include "lib/core/ranks.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/outcome.h"

namespace orthodyn {

// Throws ConfigError, at the key, for what they cannot; makes choices that are open for one process only.
void settle_for_ranks(Config& config, Scene& scene);

// How many there are; 1 for null.
int number_of(const Ranks* ranks);

// Called by a rank that has failed. Whether it is alone: the others do not come here within seconds, and nothing is
// left but to end them. `ranks`: null for this process alone.
bool failed_alone(const Ranks* ranks);
// Throws std::runtime_error where a run has failed on this rank alone.
void require_failure_of_all(const Ranks* ranks, const Outcome& outcome);

}  // namespace orthodyn
