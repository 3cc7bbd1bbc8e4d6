// An event that a scene asks for: a quantity passes a value, which is logged or ends the run.
#pragma once

#include <optional>
#include <string>

#include "lib/config/spec.h"
#include "lib/ode/event.h"

namespace orthodyn {

enum class EventAction { log, stop };

struct EventSpec {
  std::string quantity;  // "tip.displacement.z", "det_f.smallest"
  double crosses = 0;    // in the quantity's unit, SI
  Direction direction = Direction::both;
  EventAction action = EventAction::log;
  std::optional<std::string> name;  // default the quantity
  Origin origin;
  static const Spec<EventSpec>& spec();
};

}  // namespace orthodyn
