// A point of a path of equilibria at which its stiffness is singular, or where the path turns aside (load_stepper.h).
#pragma once

#include <optional>

namespace orthodyn {

struct CriticalPoint {
  // turn: K is not singular, but a body that is not quite straight buckles; or it loses a support. The displacement
  // grows far faster with the load than at first.
  enum class Kind { limit, bifurcation, turn };
  Kind kind = Kind::limit;
  double load_factor = 0;
  double uncertainty = 0;       // of load_factor
  std::optional<int> unstable;  // directions past it; none: not known
};

// "limit point", "bifurcation", "sharp turn".
inline const char* words_of(CriticalPoint::Kind kind) {
  switch (kind) {
    case CriticalPoint::Kind::limit: return "limit point";
    case CriticalPoint::Kind::bifurcation: return "bifurcation";
    default: return "sharp turn";
  }
}

}  // namespace orthodyn
