// Changes of moisture and temperature that are probably absolute values or in another unit.

#include <cmath>
#include <functional>

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

// Coefficients that are probably in per cent per unit of change.
void check_strain(const CheckContext& context, const char* field, double change,
                  const std::function<std::optional<Vec3>(const Expansion&)>& coefficients, Warnings& out) {
  constexpr double kLargest = 0.3;
  for (const auto& [name, material] : context.scene.materials) {
    const auto expansion = material->expansion();
    const auto own = expansion ? coefficients(*expansion) : std::nullopt;
    if (!own || !(own->cwiseAbs().maxCoeff() * std::abs(change) > kLargest)) continue;
    Eigen::Index axis = 0;
    own->cwiseAbs().maxCoeff(&axis);
    warn(
        out, context.config.at(field).where(),
        "a change of {:.4g} strains material '{}' by {:.3g} along axis {}: coefficients of expansion are strains, such "
        "as 0.002 for 0.2 %",
        change, name, (*own)[axis] * change, axis + 1);
  }
}

}  // namespace

void check_change(const CheckContext& context, Warnings& out) {
  if (const auto moisture = uniform_change(context.scene.moisture); moisture && std::abs(*moisture) > kSaturation)
    warn(out, context.config.at("moisture").where(),
         "a change of {:.4g} per cent is above the fibre saturation of wood, about 30 per cent, beyond which wood does "
         "not swell: give the change up to saturation",
         *moisture);
  if (const auto moisture = uniform_change(context.scene.moisture))
    check_strain(
        context, "moisture", *moisture, [](const Expansion& e) { return e.moisture; }, out);
  const auto temperature = uniform_change(context.scene.temperature);
  if (temperature)
    check_strain(
        context, "temperature", *temperature, [](const Expansion& e) { return e.temperature; }, out);
  if (temperature && *temperature >= kLeastRoom && *temperature <= kMostRoom)
    warn(out, context.config.at("temperature").where(),
         "{:.4g} K looks like an absolute temperature: give the change from the temperature at which the body has no "
         "stress",
         *temperature);
}

}  // namespace orthodyn::input_checks
