// Runs on several MPI ranks: restrictions, and failures on one rank.
#pragma once

#include "lib/config/config.h"
#include "lib/core/ranks.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/outcome.h"

namespace orthodyn {

// Throws ConfigError at the key of a feature that is not available on several ranks. Replaces `kinematics: auto` by
// corotational and switches off output.accumulated_error.
void adapt_to_ranks(Config& config, Scene& scene);

// Number of ranks; 1 for null.
int num_ranks(const Ranks* ranks);

// Call on a rank that has failed. Waits until all other ranks call this function, and returns true if they do not do so
// within 10 s; they can then only be terminated. Always false for null `ranks` (one process).
bool only_this_rank_failed(const Ranks* ranks);
// Throws std::runtime_error if the run failed on this rank only.
void require_failure_of_all(const Ranks* ranks, const Outcome& outcome);

}  // namespace orthodyn
