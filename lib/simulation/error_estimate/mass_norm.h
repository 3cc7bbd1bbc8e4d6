// Products and norms of a model's unknowns, weighted by its mass matrix M.
#pragma once

#include <algorithm>
#include <cmath>

#include "lib/ode/model.h"

namespace orthodyn {

// x^T M x
inline double mass_product(const Model& model, const Vector& x) {
  Vector Mx(x.size());
  model.multiply_mass(x, Mx);
  return x.dot(Mx);
}

// |x|_M = sqrt(x^T M x); 0 if round-off makes the product negative.
inline double mass_norm(const Model& model, const Vector& x) {
  return std::sqrt(std::max(mass_product(model, x), 0.0));
}

}  // namespace orthodyn
