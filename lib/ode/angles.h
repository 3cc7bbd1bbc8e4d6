// Angles of a state that count turns.
#pragma once

#include <numbers>

#include "lib/core/types.h"

namespace orthodyn {

struct Angles {
  Vector values, rates;  // from -pi to pi, rad; rad/s
};

// The angles plus the whole turns that bring each of them nearest to `near` (rad).
inline Vector nearest_turns(const Vector& angles, const Vector& near) {
  constexpr double kTurn = 2 * std::numbers::pi;
  return angles.array() + kTurn * ((near - angles).array() / kTurn).round();
}

}  // namespace orthodyn
