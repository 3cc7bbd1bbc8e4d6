// Chooses the highest order of the BDF methods of CVODE and IDA.
#pragma once

#include <optional>

#include "integrators/sundials/sensitivity_corrector.h"
#include "integrators/sundials/sundials_options.h"

namespace orthodyn::sundials {

// Returns `given` if it has a value. Otherwise returns 5 if no body deforms and nothing touches, or if the motion is
// well damped (damping_ratio.h), else 2.
int bdf_order(const std::optional<int>& given, const Model& model, const Task& task, double rtol, const Scales& scales);

// Spec with the keys of a BDF method. T is derived from Options and SensitivityOptions, and has a member
// `std::optional<int> max_order`.
template <class T>
Spec<T> bdf_spec() {
  auto spec = Options::spec_for<T>();
  spec.key("max_order", &T::max_order,
           "Highest order; default 5 if all bodies are rigid and there is no contact, or if the damping ratio of the "
           "motion is above 1e-3 (5e-3 at rtol >= 5e-3), else 2.",
           {.range = {1, 5}});
  SensitivityOptions::add_to(spec);
  return spec;
}

}  // namespace orthodyn::sundials
