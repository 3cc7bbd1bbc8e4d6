// Events: during an integration a scalar of the state crosses a given value.
#pragma once

#include <functional>
#include <string>

#include "lib/ode/output.h"

namespace orthodyn {

enum class Direction { up, down, both };

struct Event {
  std::string name;
  std::function<double(const ObservedState&)> quantity;
  double value = 0;  // in the quantity's unit
  Direction direction = Direction::both;
  bool stops = false;  // ends the run at the crossing
};

struct Crossing {
  const Event* event = nullptr;
  State state;
  bool upward = false;
};

}  // namespace orthodyn
