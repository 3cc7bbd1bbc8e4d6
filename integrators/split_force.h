// A model's force as the sum of two models' forces: the parts that a scheme treats explicitly, by name, and
// the others.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/ode/model.h"

namespace orthodyn {

struct SplitForce {
  std::unique_ptr<Model> explicit_part, implicit_part;
};

// Throws ConfigError, with the parts that there are, if a name is unknown, if the model's force has no parts
// or if either sum would be empty: without a place, for the caller knows the key. `model` must outlive the result.
SplitForce split_force(const Model& model, const std::vector<std::string>& explicit_names);

}  // namespace orthodyn
