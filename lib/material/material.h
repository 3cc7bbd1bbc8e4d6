// A material: density and elasticity tensor in its own axes. One kind per file, chosen in the input
// by `type` through Registry<Material>.
#pragma once

#include <string>
#include <vector>

#include "lib/config/registry.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

class Material {
 public:
  virtual ~Material() = default;
  virtual double density() const { return density_; }  // kg/m^3
  virtual Stiffness stiffness() const = 0;             // positive definite

  // What of the input was changed to make it usable, one sentence each; empty if nothing was.
  virtual std::vector<std::string> notes() const { return {}; }

 protected:
  double density_ = 0;
};

}  // namespace orthodyn
