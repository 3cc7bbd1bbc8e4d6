#include "lib/ode/integrator_settings.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

std::vector<std::pair<const char*, double>> numbers(const IntegratorSettings& s) {
  std::vector<std::pair<const char*, double>> given;
  const auto add = [&](const char* key, const auto& value) {
    if (value) given.emplace_back(key, static_cast<double>(*value));
  };
  add("step", s.step);
  add("safety", s.safety);
  add("rtol", s.rtol);
  add("modes", s.modes);
  add("below", s.below);
  add("h_max", s.h_max);
  add("h_min", s.h_min);
  add("h0", s.h0);
  add("position_scale", s.position_scale);
  add("velocity_scale", s.velocity_scale);
  add("max_steps", s.max_steps);
  return given;
}

void check_ranges(const IntegratorSettings& settings, const std::vector<Key>& keys) {
  for (const auto& [name, value] : numbers(settings))
    for (const Key& key : keys)
      if (key.name == name && !key.range.contains(value))
        throw ConfigError(fmt::format("{}: must be {}{}{}, found {}", name, range_text(key.range),
                                      key.unit.empty() ? "" : " ", key.unit, value));
}

}  // namespace orthodyn
