// Pseudo-random vectors. They have no symmetry, so that no mode of a symmetric body is missed.
#pragma once

#include <random>

#include "lib/ode/model.h"

namespace orthodyn {

// Returns a vector with entries between -1/2 and 1/2, which are reproducible and independent of the number of ranks.
inline Vector random_vector(const Model& model) {
  std::mt19937 generator(1);
  Vector all(model.num_dofs_of_all());
  for (double& value : all) value = static_cast<double>(generator()) / std::mt19937::max() - 0.5;
  return model.part_of(all);
}

}  // namespace orthodyn
