#include "lib/scene/events.h"

#include <fmt/format.h>

#include "lib/scene/quantity.h"

namespace orthodyn {

std::vector<Event> make_events(const Scene& scene, const FemModel& model) {
  std::vector<Event> events;
  for (const auto& spec : scene.events) {
    const Quantity quantity = find_quantity(spec.quantity, scene, model, spec.origin);
    if (!quantity.values) spec.origin.fail(fmt::format("'{}' is known at output times only; choose another quantity", spec.quantity));
    if (quantity.components != 1)
      spec.origin.fail(fmt::format("'{}' is a vector: choose .x, .y, .z or .magnitude", spec.quantity));
    events.push_back({spec.name.value_or(spec.quantity),
                      [values = quantity.values](const State& state) { return values(state)[0]; }, spec.crosses,
                      spec.direction, spec.action == EventAction::stop});
  }
  return events;
}

}  // namespace orthodyn
