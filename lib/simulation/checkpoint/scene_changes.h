// What a scene may change when it goes on from a checkpoint, and what it did change.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

// A resolved scene, perhaps of an earlier version, with the defaults of keys that it does not have.
Config with_defaults(const Config& scene);

// Paths of values that differ, in the order of `now`. Numbers are compared as numbers, with their units; a key without
// a value counts as absent. What the program says of its choices in words (`integrator.kept`) is none.
std::vector<std::string> changed_keys(const Config& before, const Config& now);

// Of `changed`, those that make it another simulation: all but the end of the time span, checkpoints,
// expectations and limits of the integrator that do not touch its accuracy.
std::vector<std::string> refused_changes(const std::vector<std::string>& changed);

}  // namespace orthodyn
