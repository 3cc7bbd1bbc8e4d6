#include "lib/ode/integrator_settings.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

std::vector<std::pair<const char*, double>> numeric_settings(const IntegratorSettings& s) {
  std::vector<std::pair<const char*, double>> given;
  for_each_setting(s, s, [&](const char* key, const auto& value, const auto&) {
    if constexpr (requires { static_cast<double>(*value); })
      if (value) given.emplace_back(key, static_cast<double>(*value));
  });
  return given;
}

void check_ranges(const IntegratorSettings& settings, const std::vector<Key>& keys) {
  for (const auto& [name, value] : numeric_settings(settings))
    for (const Key& key : keys)
      if (key.name == name && !key.range.contains(value))
        throw ConfigError(fmt::format("{}: must be {}{}{}, found {}", name, range_text(key.range),
                                      key.unit.empty() ? "" : " ", key.unit, value));
}

}  // namespace orthodyn
