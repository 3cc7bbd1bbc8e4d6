// A point of a path of equilibria at which the stiffness is singular or the path turns sharply (load_stepper.h).
#pragma once

#include <optional>

namespace orthodyn {

struct CriticalPoint {
  // turn: K is regular, but displacements grow far faster with the load than at the start: an imperfect body buckles,
  // or the body loses a support.
  enum class Kind { limit, bifurcation, turn };
  Kind kind = Kind::limit;
  double load_factor = 0;
  double uncertainty = 0;       // uncertainty of load_factor
  std::optional<int> unstable;  // number of unstable directions past the point; empty if unknown
};

// Returns "limit point", "bifurcation" or "sharp turn".
inline const char* words_of(CriticalPoint::Kind kind) {
  switch (kind) {
    case CriticalPoint::Kind::limit: return "limit point";
    case CriticalPoint::Kind::bifurcation: return "bifurcation";
    default: return "sharp turn";
  }
}

}  // namespace orthodyn
