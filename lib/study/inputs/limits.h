// Limits of one run of a study: the section `limits` of its file.
#pragma once

#include "lib/config/spec.h"

namespace orthodyn {

// Allowed wall time limits, s.
inline constexpr Range kLimitSeconds{0, 1e7, true, false};

struct Limits {
  double seconds = 60;  // wall time of one integration
  double memory = 8e9;  // bytes, of all processes of one point on this machine
  static const Spec<Limits>& spec();
};

inline const Spec<Limits>& Limits::spec() {
  static const auto s =
      Spec<Limits>()
          .key("seconds", &Limits::seconds, "Wall time limit of one integration.",
               {.unit = "s", .range = kLimitSeconds})
          .key("memory", &Limits::memory, "Memory limit of one point: its process, or all its ranks on this machine.",
               {.unit = "bytes", .range = kPositive});
  return s;
}

}  // namespace orthodyn
