#include "lib/ode/integrator_settings.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

void check_ranges(const IntegratorSettings& settings, const std::vector<Key>& keys) {
  const auto check = [&](const char* name, std::optional<double> value) {
    for (const Key& key : keys)
      if (value && key.name == name && !key.range.contains(*value))
        throw ConfigError(fmt::format("{}: must be {}{}{}, found {}", name, range_text(key.range),
                                      key.unit.empty() ? "" : " ", key.unit, *value));
  };
  check("rtol", settings.rtol);
  check("step", settings.step);
  check("h0", settings.h0);
  check("h_min", settings.h_min);
  check("h_max", settings.h_max);
  check("position_scale", settings.position_scale);
  check("velocity_scale", settings.velocity_scale);
  check("safety", settings.safety);
  check("max_steps", settings.max_steps);
}

}  // namespace orthodyn
