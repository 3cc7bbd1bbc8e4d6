// Events that cannot happen: a value that the quantity never has.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarthestEvent = 3;  // lengths of a held body
// Of the stiffness: a stress that no body bears, and one of no interest.
constexpr double kLargestStress = 1, kSmallestStress = 1e-9;

bool is_never_negative(const std::string& quantity) {
  constexpr std::array<const char*, 4> kEnergies{"energy.kinetic", "energy.elastic", "power.dissipated", "imbalance"};
  for (const char* name : kEnergies)
    if (quantity == name) return true;
  return quantity.ends_with(".magnitude");
}

// max_stress is an exposure, a plain number.
bool is_stress(const std::string& quantity) {
  const auto has = [&](const char* words) { return quantity.find(words) != std::string::npos; };
  return (has("stress") && !has("max_stress")) || has("von_mises");
}

// Pa, the largest normal modulus of any region.
double stiffest(const FemModel& model) {
  double largest = 0;
  for (const auto& term : model.parts().elastic) largest = std::max(largest, term->stiffness().diagonal().maxCoeff());
  return largest;
}

}  // namespace

void check_event(const Subject& subject, Warnings& out) {
  for (std::size_t k = 0; k < subject.scene.events.size(); ++k) {
    const EventSpec& event = subject.scene.events[k];
    const std::string place = subject.config.at("events").at(k).where();
    if (event.crosses < 0 && is_never_negative(event.quantity))
      out.push_back(
          fmt::format("{}: {} is never below 0, and cannot cross {:.4g}", place, event.quantity, event.crosses.si()));
    if (subject.held() && event.quantity.find(".displacement") != std::string::npos &&
        std::abs(event.crosses) > kFarthestEvent * subject.extent)
      out.push_back(fmt::format("{}: {:.4g} m is {:.3g} times the length of the body, which is held: is that in mm?",
                                place, event.crosses.si(), std::abs(event.crosses) / subject.extent));
    if (is_stress(event.quantity)) {
      const double stress = std::abs(event.crosses), modulus = stiffest(*subject.built.model);
      if (stress > kLargestStress * modulus)
        out.push_back(
            fmt::format("{}: {:.3g} Pa is more than the moduli of the body, of {:.3g} Pa at most: no stress "
                        "comes to that. Is its unit one too large?",
                        place, stress, modulus));
      if (stress > 0 && stress < kSmallestStress * modulus)
        out.push_back(
            fmt::format("{}: {:.3g} Pa is a stress of {:.1g} of the moduli, which is reached at once: is the "
                        "unit missing, such as MPa?",
                        place, stress, stress / modulus));
    }
    if (event.quantity.find(".velocity") != std::string::npos && std::abs(event.crosses) > 10 * subject.wave)
      out.push_back(fmt::format("{}: {:.4g} m/s is faster than the waves in the body ({:.3g} m/s): is that in mm/s?",
                                place, event.crosses.si(), subject.wave));
  }
}

}  // namespace orthodyn::input_checks
