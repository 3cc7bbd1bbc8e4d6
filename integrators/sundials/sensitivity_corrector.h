// The key that chooses how the steps of CVODES and IDAS solve for sensitivities.
//
// staggered: Newton's method first solves for the motion, then for all sensitivities at the end of the step (Feehery,
// Tolsma & Barton 1997). simultaneous: for the motion and all sensitivities together, with the same matrix for each
// (Maly & Petzold 1996), by the library's own modified Newton method. Each iteration then evaluates df/dp and the
// tangent at a new state.
#pragma once

#include <array>
#include <utility>

#include "lib/config/spec.h"

namespace orthodyn {

enum class SensitivityCorrector { staggered, simultaneous };

template <>
struct EnumNames<SensitivityCorrector> {
  static constexpr std::array<std::pair<SensitivityCorrector, const char*>, 2> list{
      {{SensitivityCorrector::staggered, "staggered"}, {SensitivityCorrector::simultaneous, "simultaneous"}}};
};

namespace sundials {

struct SensitivityOptions {
  SensitivityCorrector sensitivity_corrector = SensitivityCorrector::staggered;

  bool is_simultaneous() const { return sensitivity_corrector == SensitivityCorrector::simultaneous; }

  // Adds the key to the Spec of a struct derived from this one.
  template <class T>
  static Spec<T>& add_to(Spec<T>& spec) {
    return spec.key("sensitivity_corrector", &SensitivityOptions::sensitivity_corrector,
                    "Solution for `sensitivities` in each step: staggered, after that for the motion, or simultaneous, "
                    "together with it. Used only with sensitivities.");
  }
};

}  // namespace sundials
}  // namespace orthodyn
