// A point of a path of equilibria at which its stiffness is singular (load_stepper.h).
#pragma once

#include <optional>

namespace orthodyn {

struct CriticalPoint {
  enum class Kind { limit, bifurcation };
  Kind kind = Kind::limit;
  double load_factor = 0;
  double uncertainty = 0;       // of load_factor
  std::optional<int> unstable;  // directions past it; none: not known
};

}  // namespace orthodyn
