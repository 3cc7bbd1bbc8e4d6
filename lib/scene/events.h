// The list `events`: quantities and thresholds. A crossing is logged or ends the run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/quantity_value.h"
#include "lib/config/spec.h"
#include "lib/ode/event.h"

namespace orthodyn {

class FemModel;
struct Scene;

enum class EventAction { log, stop };

struct EventSpec {
  std::string quantity;   // "tip.displacement.z", "det_f.smallest"
  QuantityValue crosses;  // in the quantity's unit
  Direction direction = Direction::both;
  EventAction action = EventAction::log;
  std::optional<std::string> name;  // default: the quantity
  SourceLocation origin;
  static const Spec<EventSpec>& spec();
};

// The scene's events for a run. Throws ConfigError if a quantity does not exist, is a vector, or is available at output
// times only. `model` must outlive the events.
std::vector<Event> make_events(const Scene& scene, const FemModel& model);

}  // namespace orthodyn
