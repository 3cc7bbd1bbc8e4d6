// What the multistep methods have beside the keys of all: their highest order.
#pragma once

#include "integrators/damping_ratio.h"
#include "integrators/sundials/sundials_options.h"
#include "lib/core/errors.h"

namespace orthodyn::sundials {

struct MultistepOptions : Options {
  std::optional<int> max_order;

  template <class T>
  static Spec<T> spec_for() {
    return Options::spec_for<T>().key("max_order", &MultistepOptions::max_order,
                                      "Highest order; default 5 where the motion is well damped, by a ratio above "
                                      "1e-3 (5e-3 at rtol >= 5e-3), else 2.",
                                      {.range = {1, 5}});
  }
};

struct MultistepSettings : Settings {
  int max_order;

  static MultistepSettings complete(const MultistepOptions& options, const Model& model, const Task& task) {
    MultistepSettings s{Settings::complete(options, task), 0};
    s.max_order = options.max_order ? *options.max_order : default_order(model, task.initial, s);
    s.decisions.emplace_back("max_order", std::to_string(s.max_order));
    return s;
  }

 private:
  static int default_order(const Model& model, const State& start, const Settings& settings) {
    if (!model.traits().damped) return 2;
    Statistics unused;
    CriticalStep critical(model, unused);
    try {
      critical.at_present(start);
    } catch (const RecoverableError&) {  // the start has its own sentence for it
      return 2;
    }
    const double ratio = damping_ratio_of_motion(critical, settings.scales);
    return suits_high_orders(ratio, settings.options.rtol) ? 5 : 2;
  }
};

}  // namespace orthodyn::sundials
