#include "lib/scene/events.h"

#include <fmt/format.h>

#include "lib/scene/quantity.h"
#include "lib/scene/scene.h"

namespace orthodyn {

template <>
struct EnumNames<Direction> {
  static constexpr std::array<std::pair<Direction, const char*>, 3> list{
      {{Direction::up, "up"}, {Direction::down, "down"}, {Direction::both, "both"}}};
};
template <>
struct EnumNames<EventAction> {
  static constexpr std::array<std::pair<EventAction, const char*>, 2> list{
      {{EventAction::log, "log"}, {EventAction::stop, "stop"}}};
};

const Spec<EventSpec>& EventSpec::spec() {
  static const auto s =
      Spec<EventSpec>()
          .key("quantity", &EventSpec::quantity,
               "A probe's field and component (tip.displacement.z, or .magnitude) or a scalar of the whole body "
               "(energy.kinetic, von_mises.largest).",
               {.required = true})
          .key("crosses", &EventSpec::crosses, "Threshold of the quantity, in SI units or with a unit.",
               {.required = true, .unit = kUnitOfQuantity})
          .key("direction", &EventSpec::direction, "Direction of the crossings that count.")
          .key("action", &EventSpec::action, "log: a row in events.csv; stop: the run also ends there.")
          .key("name", &EventSpec::name, "Name of the event in events.csv; default the quantity.")
          .check([](const EventSpec& e, const Config& config) {
            if (e.name && e.name->find_first_of(",\"\n") != std::string::npos)
              config.at("name").fail("is written to a CSV file: it must not contain commas, quotes or line breaks");
          });
  return s;
}

std::vector<Event> make_events(const Scene& scene, const FemModel& model) {
  std::vector<Event> events;
  for (const auto& spec : scene.events) {
    const Quantity quantity = find_quantity(spec.quantity, scene, model, spec.origin);
    if (!quantity.values)
      spec.origin.fail(fmt::format("'{}' is available at output times only; choose another quantity", spec.quantity));
    if (quantity.components() > 1) spec.origin.fail(quantity.ask_for_component());
    spec.crosses.require(quantity.unit, {spec.origin.where + ".crosses"});
    events.push_back({spec.name.value_or(spec.quantity),
                      [values = quantity.values](const ObservedState& observed) { return values(observed)[0]; },
                      spec.crosses, spec.direction, spec.action == EventAction::stop});
  }
  return events;
}

}  // namespace orthodyn
