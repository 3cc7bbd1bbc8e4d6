#include "lib/material/fibres/fibres.h"

namespace orthodyn {

const Spec<ActiveFibre>& ActiveFibre::spec() {
  static const auto s =
      Spec<ActiveFibre>()
          .key("stress", &ActiveFibre::stress,
               "Peak isometric stress: force per area at rest, at activation 1 and the best stretch.",
               {.required = true, .unit = "Pa", .range = kPositive})
          .key("length", &ActiveFibre::length, "Factor of the stress by the stretch.", {.fallback = "{type: gaussian}"})
          .key("velocity", &ActiveFibre::velocity,
               "Factor of the stress by the rate of the stretch; without it the stress does not depend on the rate.");
  return s;
}

const Spec<Fibres>& Fibres::spec() {
  static const auto s = Spec<Fibres>()
                            .key("passive", &Fibres::passive, "Stress of the stretched fibre; zero in compression.")
                            .key("active", &Fibres::active, "Contraction, by the scene's key `activation`.")
                            .check([](const Fibres& fibres, const Config& config) {
                              if (!fibres.passive && !fibres.active)
                                config.fail("is empty; give passive, active or both");
                            });
  return s;
}

}  // namespace orthodyn
