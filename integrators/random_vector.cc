#include "integrators/random_vector.h"

#include <random>

namespace orthodyn {

Vector random_vector(const Model& model) {
  std::mt19937 generator(1);
  Vector all(model.num_dofs_of_all());
  for (double& value : all) value = static_cast<double>(generator()) / std::mt19937::max() - 0.5;
  return model.part_of(all);
}

}  // namespace orthodyn
