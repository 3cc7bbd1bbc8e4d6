#include "lib/scene/damping.h"

namespace orthodyn {

const Spec<Damping>& Damping::spec() {
  static const auto s = Spec<Damping>()
                            .key("mass", &Damping::mass, "Mass-proportional (Rayleigh alpha): drag on all motion.",
                                 {.unit = "1/s", .range = kNonNegative})
                            .key("stiffness", &Damping::stiffness,
                                 "Stiffness-proportional (Rayleigh beta), objective: no damping of rigid motion.",
                                 {.unit = "s", .range = kNonNegative});
  return s;
}

}  // namespace orthodyn
