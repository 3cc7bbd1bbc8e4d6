// How a scene's equilibrium is to be found: keys of the section `statics`.
#pragma once

#include <memory>

#include "lib/statics/equilibrium.h"
#include "lib/statics/load_stepper.h"

namespace orthodyn {

struct Statics : LoadStepping {
  std::shared_ptr<const EquilibriumChoice> solver;
  static const Spec<Statics>& spec();
};

}  // namespace orthodyn
