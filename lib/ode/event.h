// A quantity of the state that passes a value while a model is integrated.
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
  bool stops = false;  // the run ends there
};

// One passing of one event.
struct Crossing {
  const Event* event = nullptr;
  State state;
  bool upward = false;
};

}  // namespace orthodyn
