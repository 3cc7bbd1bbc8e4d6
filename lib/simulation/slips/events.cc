// Events that cannot happen: a value that the quantity never has.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "lib/simulation/slips/subject.h"

namespace orthodyn::slip {

namespace {

constexpr double kFarthestEvent = 100;  // lengths of a held body

bool is_never_negative(const std::string& quantity) {
  constexpr std::array<const char*, 4> kEnergies{"energy.kinetic", "energy.elastic", "power.dissipated", "imbalance"};
  for (const char* name : kEnergies)
    if (quantity == name) return true;
  return quantity.ends_with(".magnitude");
}

}  // namespace

void add_event_slips(const Subject& subject, Warnings& out) {
  for (std::size_t k = 0; k < subject.scene.events.size(); ++k) {
    const EventSpec& event = subject.scene.events[k];
    const std::string place = subject.config.at("events").at(k).where();
    if (event.crosses < 0 && is_never_negative(event.quantity))
      out.push_back(fmt::format("{}: {} never is below 0, and cannot cross {:.4g}", place, event.quantity,
                                event.crosses.si()));
    if (subject.held() && event.quantity.find(".displacement") != std::string::npos &&
        std::abs(event.crosses) > kFarthestEvent * subject.extent)
      out.push_back(fmt::format("{}: {:.4g} m is {:.0f} times the length of the body, which is held: is that in mm?",
                                place, event.crosses.si(), std::abs(event.crosses) / subject.extent));
    if (event.quantity.find(".velocity") != std::string::npos && std::abs(event.crosses) > 10 * subject.wave)
      out.push_back(fmt::format("{}: {:.4g} m/s is faster than the waves in the body ({:.3g} m/s): is that in mm/s?",
                                place, event.crosses.si(), subject.wave));
  }
}

}  // namespace orthodyn::slip
