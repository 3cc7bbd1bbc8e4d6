// A material: density and elasticity tensor in its own axes. One kind per file, chosen in the input
// by `type` through Registry<Material>.
#pragma once

#include "lib/core/registry.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

class Material {
 public:
  virtual ~Material() = default;
  double density() const { return density_; }  // kg/m^3
  virtual Stiffness stiffness() const = 0;     // positive definite

 protected:
  double density_ = 0;
};

}  // namespace orthodyn
