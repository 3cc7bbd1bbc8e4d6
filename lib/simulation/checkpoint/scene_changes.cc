#include "lib/simulation/checkpoint/scene_changes.h"

#include <algorithm>
#include <optional>

#include "lib/config/values.h"
#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

constexpr const char* kAllowedChanges[] = {"time.end",
                                           "checkpoint",
                                           "expect",
                                           "integrator.max_steps",
                                           "integrator.h_min",
                                           "integrator.max_newton_iterations",
                                           "output.accumulated_error",
                                           "threads"};

// Keys that explain automatic choices. They are not compared, because digits in their texts may differ.
constexpr const char* kExplanations[] = {"integrator.kept", "integrator.because"};

// One unit for each dimension.
constexpr const char* kUnits[] = {"m", "s",  "Pa",  "kg/m^3", "m/s",   "m/s^2", "rad",  "rad/s",
                                  "N", "Hz", "1/s", "N/m",    "N s/m", "Pa/m",  "bytes"};

std::optional<double> number(const Config& value, const char* unit) {
  try {
    return read_number(value, {.unit = unit});
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

// Compares numbers in the first unit in which both can be read: "25 mm" equals 0.025.
bool same_scalar(const Config& a, const Config& b) {
  if (a.text() == b.text()) return true;
  for (const char* unit : kUnits) {
    const auto x = number(a, unit), y = number(b, unit);
    if (x && y) return *x == *y;
  }
  return false;
}

bool is_given(const Config& section, const std::string& key) { return section.has(key) && !section.at(key).is_null(); }

std::string below(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

void compare(const Config& before, const Config& now, const std::string& path, std::vector<std::string>& changed) {
  if (std::find(std::begin(kExplanations), std::end(kExplanations), path) != std::end(kExplanations)) return;
  if (before.is_map() && now.is_map()) {
    auto keys = now.keys();
    for (const auto& key : before.keys())
      if (!now.has(key)) keys.push_back(key);
    for (const auto& key : keys) {
      const bool was = is_given(before, key), is = is_given(now, key);
      if (was && is) compare(before.at(key), now.at(key), below(path, key), changed);
      else if (was != is) changed.push_back(below(path, key));
    }
  } else if (before.is_sequence() && now.is_sequence() && before.size() == now.size()) {
    for (std::size_t i = 0; i < now.size(); ++i)
      compare(before.at(i), now.at(i), below(path, std::to_string(i)), changed);
  } else if (!(before.is_scalar() && now.is_scalar() && same_scalar(before, now)) &&
             !(before.is_null() && now.is_null())) {
    changed.push_back(path);
  }
}

}  // namespace

Config with_defaults(const Config& scene) {
  Config all = scene.resolving();
  read_scene(all);
  return all;
}

std::vector<std::string> changed_keys(const Config& before, const Config& now) {
  std::vector<std::string> changed;
  compare(before, now, "", changed);
  return changed;
}

std::vector<std::string> refused_changes(const std::vector<std::string>& changed) {
  std::vector<std::string> refused;
  for (const auto& path : changed) {
    const auto allows = [&](const std::string& key) { return path == key || path.starts_with(key + "."); };
    if (std::none_of(std::begin(kAllowedChanges), std::end(kAllowedChanges), allows)) refused.push_back(path);
  }
  return refused;
}

}  // namespace orthodyn
