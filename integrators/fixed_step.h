// The key `step` of methods that take a fixed step in place of error control.
#pragma once

#include <optional>
#include <string>

#include "lib/config/spec.h"

namespace orthodyn {

struct FixedStep {
  std::optional<double> step;  // s

  // This key, in a Spec of a struct that has the keys of ErrorControl too.
  template <class T>
  static void add_to(Spec<T>& spec, const std::string& sentence) {
    spec.key("step", &FixedStep::step, sentence, {.unit = "s", .range = kPositive})
        .check([](const T& options, const Config& config) {
          if (!options.step) return;
          if (options.h0) config.at("h0").fail("has no meaning with a fixed step");
          if (options.h_max) config.at("h_max").fail("has no meaning with a fixed step");
          if (options.h_min > 0) config.at("h_min").fail("has no meaning with a fixed step");
        });
  }
};

// The next step towards a stop that is `rest` away, s. The last two are equal: a tiny last one would spoil the
// extrapolation of methods that remember the step before. `round_off` is relative.
inline double length_of_step(double step, double rest, double round_off = 0) {
  if (rest <= step * (1 + round_off)) return rest;
  return rest < 2 * step * (1 - round_off) ? 0.5 * rest : step;
}

// The same where the ends of many equal steps do not quite meet the stop.
inline double length_of_fixed_step(double step, double rest) { return length_of_step(step, rest, 1e-6); }

}  // namespace orthodyn
