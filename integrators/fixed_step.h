// The key `step` of methods that take a fixed step in place of error control.
#pragma once

#include <optional>
#include <string>

#include "lib/core/spec.h"

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

// The last step before a stop is what is left, without a sliver of round-off after it.
inline double length_of_step(double step, double rest) { return rest > step * (1 + 1e-6) ? step : rest; }

}  // namespace orthodyn
