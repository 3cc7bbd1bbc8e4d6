// Changes of moisture and temperature that are probably absolute values or in another unit.

#include <cmath>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kSaturation = 35;                   // %; wood does not swell above about 30 %
constexpr double kLeastRoom = 270, kMostRoom = 320;  // K, of absolute temperatures in rooms and outdoors

// The value of a uniform change; empty without one.
std::optional<double> uniform_change(const std::optional<StateChange>& change) {
  if (!change || !change->change || !change->change->uniform()) return {};
  return change->change->at(Vec3::Zero());
}

}  // namespace

void check_change(const CheckContext& context, Warnings& out) {
  if (const auto moisture = uniform_change(context.scene.moisture); moisture && std::abs(*moisture) > kSaturation)
    warn(out, context.config.at("moisture").where(),
         "a change of {:.4g} per cent is above the fibre saturation of wood, about 30 per cent, beyond which wood does "
         "not swell: give the change up to saturation",
         *moisture);
  const auto temperature = uniform_change(context.scene.temperature);
  if (temperature && *temperature >= kLeastRoom && *temperature <= kMostRoom)
    warn(out, context.config.at("temperature").where(),
         "{:.4g} K looks like an absolute temperature: give the change from the temperature at which the body has no "
         "stress",
         *temperature);
}

}  // namespace orthodyn::input_checks
