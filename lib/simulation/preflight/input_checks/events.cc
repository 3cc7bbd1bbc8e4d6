// Events that cannot occur: values that the quantity never reaches.

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarthestEvent = 3;  // displacement over the length of a body with supports
// Stress over the largest modulus: one that no body bears, and a negligible one.
constexpr double kLargestStress = 1, kSmallestStress = 1e-9;

bool is_never_negative(const std::string& quantity) {
  constexpr std::array<const char*, 4> kEnergies{"energy.kinetic", "energy.elastic", "power.dissipated", "imbalance"};
  for (const char* name : kEnergies)
    if (quantity == name) return true;
  return quantity.ends_with(".magnitude");
}

// max_stress is a failure criterion, without unit.
bool is_stress(const std::string& quantity) {
  const auto has = [&](const char* words) { return quantity.find(words) != std::string::npos; };
  return (has("stress") && !has("max_stress")) || has("von_mises");
}

// Largest normal modulus of any region, Pa.
double stiffest(const FemModel& model) {
  double largest = 0;
  for (const auto& term : model.parts().elastic) largest = std::max(largest, term->stiffness().diagonal().maxCoeff());
  return largest;
}

}  // namespace

void check_event(const CheckContext& context, Warnings& out) {
  for (std::size_t k = 0; k < context.scene.events.size(); ++k) {
    const EventSpec& event = context.scene.events[k];
    const std::string place = context.config.at("events").at(k).where();
    if (event.crosses < 0 && is_never_negative(event.quantity))
      warn(out, place, "{} is never below 0, and cannot cross {:.4g}", event.quantity, event.crosses.si());
    if (context.has_supports() && event.quantity.find(".displacement") != std::string::npos &&
        std::abs(event.crosses) > kFarthestEvent * context.extent)
      warn(out, place, "{:.4g} m is {:.3g} times the length of the body, which has supports: is it in mm?",
           event.crosses.si(), std::abs(event.crosses) / context.extent);
    if (is_stress(event.quantity)) {
      const double stress = std::abs(event.crosses), modulus = stiffest(*context.built.model);
      if (stress > kLargestStress * modulus)
        warn(out, place,
             "{:.3g} Pa exceeds the moduli of the body (at most {:.3g} Pa): no stress reaches it. Is its unit too "
             "large?",
             stress, modulus);
      if (stress > 0 && stress < kSmallestStress * modulus)
        warn(out, place,
             "{:.3g} Pa is {:.1g} of the moduli; so small a stress is reached at once: is the unit missing, such as "
             "MPa?",
             stress, stress / modulus);
    }
    if (event.quantity.find(".velocity") != std::string::npos && std::abs(event.crosses) > 10 * context.wave_speed)
      warn(out, place, "{:.4g} m/s is faster than the waves in the body ({:.3g} m/s): is it in mm/s?",
           event.crosses.si(), context.wave_speed);
  }
}

}  // namespace orthodyn::input_checks
