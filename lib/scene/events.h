// Events, the list `events`: a quantity passes a value, which is logged or ends the run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/measured.h"
#include "lib/config/spec.h"
#include "lib/ode/event.h"

namespace orthodyn {

class FemModel;
struct Scene;

enum class EventAction { log, stop };

struct EventSpec {
  std::string quantity;  // "tip.displacement.z", "det_f.smallest"
  Measured crosses;      // in the quantity's unit
  Direction direction = Direction::both;
  EventAction action = EventAction::log;
  std::optional<std::string> name;  // default the quantity
  SourceLocation origin;
  static const Spec<EventSpec>& spec();
};

// A scene's events, ready to be looked for. Throws ConfigError for a quantity that the scene does not have or that is a
// vector. `model` must outlive them.
std::vector<Event> make_events(const Scene& scene, const FemModel& model);

}  // namespace orthodyn
