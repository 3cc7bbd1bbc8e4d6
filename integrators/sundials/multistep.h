// What the multistep methods have beside the keys of all: their highest order.
#pragma once

#include "integrators/sundials/sundials_options.h"

namespace orthodyn::sundials {

struct MultistepOptions : Options {
  std::optional<int> max_order;

  template <class T>
  static Spec<T> spec_for() {
    return Options::spec_for<T>().key("max_order", &MultistepOptions::max_order,
                                      "Highest order; default 5 with stiffness damping everywhere, else 2.",
                                      {.range = {1, 5}});
  }
};

struct MultistepSettings : Settings {
  int max_order;

  // Orders above 2 stall on undamped oscillations: part of the imaginary axis is unstable for them.
  static MultistepSettings complete(const MultistepOptions& options, const Model& model,
                                    const Task& task) {
    MultistepSettings s{Settings::complete(options, task),
                        options.max_order.value_or(model.traits().damped ? 5 : 2)};
    s.decisions.emplace_back("max_order", std::to_string(s.max_order));
    return s;
  }
};

}  // namespace orthodyn::sundials
