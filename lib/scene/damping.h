// The section `damping`: Rayleigh damping, force -(alpha M + beta K) v.
#pragma once

#include "lib/config/spec.h"

namespace orthodyn {

struct Damping {
  double mass = 0;       // alpha, 1/s
  double stiffness = 0;  // beta, s
  static const Spec<Damping>& spec();
};

}  // namespace orthodyn
