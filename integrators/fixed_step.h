// The key `step`: a fixed step instead of error control.
#pragma once

#include <optional>
#include <string>

#include "lib/config/spec.h"

namespace orthodyn {

struct FixedStep {
  std::optional<double> step;  // s

  // Adds this key, described by `sentence`, to the Spec of a struct derived from this one and from ErrorControl. Input
  // with `step` must not contain h0, h_min or h_max.
  template <class T>
  static Spec<T>& add_to(Spec<T>& spec, const std::string& sentence) {
    return spec.key("step", &FixedStep::step, sentence, {.unit = "s", .range = kPositive})
        .check([](const T& options, const Config& config) {
          if (!options.step) return;
          if (options.h0) config.at("h0").fail("is not used with a fixed step");
          if (options.h_max) config.at("h_max").fail("is not used with a fixed step");
          if (options.h_min > 0) config.at("h_min").fail("is not used with a fixed step");
        });
  }
};

// Length (s) of the next step if the stop is `rest` (s) away. The last two steps are equal, because a tiny last step
// would spoil the extrapolation of methods that use the previous step. `round_off`: relative round-off of `rest` to be
// tolerated.
inline double length_of_step(double step, double rest, double round_off = 0) {
  if (rest <= step * (1 + round_off)) return rest;
  return rest < 2 * step * (1 - round_off) ? 0.5 * rest : step;
}

// As length_of_step(), but tolerates the round-off of a sum of many equal steps.
inline double length_of_fixed_step(double step, double rest) { return length_of_step(step, rest, 1e-6); }

}  // namespace orthodyn
