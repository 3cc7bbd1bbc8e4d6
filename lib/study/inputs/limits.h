// What one run of a study may take, as the key `limits` of its file says.
#pragma once

#include "lib/config/spec.h"

namespace orthodyn {

// The range of a limit of wall time, s.
inline constexpr Range kLimitSeconds{0, 1e7, true, false};

struct Limits {
  double seconds = 60;  // of wall time of one integration
  double memory = 8e9;  // bytes in use by what computes a point, all its ranks on this machine
  static const Spec<Limits>& spec();
};

inline const Spec<Limits>& Limits::spec() {
  static const auto s =
      Spec<Limits>()
          .key("seconds", &Limits::seconds, "Wall time of one integration.", {.unit = "s", .range = kLimitSeconds})
          .key("memory", &Limits::memory, "Memory in use by one point: its process, or its ranks on this machine.",
               {.unit = "bytes", .range = kPositive});
  return s;
}

}  // namespace orthodyn
