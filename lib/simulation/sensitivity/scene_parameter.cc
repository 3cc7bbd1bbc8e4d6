#include "lib/simulation/sensitivity/scene_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/core/units.h"

namespace orthodyn {

namespace {

// The entry `name` of a section or list. Throws ConfigError if there is none.
Config entry(const Config& at, const std::string& name, const std::string& path) {
  if (at.is_map()) {
    if (at.has(name)) return at.at(name);
    at.fail(fmt::format("'{}' is not a parameter of this scene: no key '{}'{} There are {}", path, name,
                        did_you_mean(name, at.keys(), "."), join(at.keys())));
  }
  if (at.is_sequence()) {
    constexpr std::size_t kDigits = 9;
    const bool is_index =
        !name.empty() && name.size() <= kDigits && name.find_first_not_of("0123456789") == std::string::npos;
    if (is_index && std::stoul(name) < at.size()) return at.at(std::stoul(name));
    at.fail(fmt::format("'{}' is not a parameter of this scene: '{}' is no entry of a list of {}, counted from 0", path,
                        name, at.size()));
  }
  at.fail(fmt::format("'{}' is not a parameter of this scene: {} has no entries", path, at.shown()));
}

bool is_unit_of_angles(const std::string& unit) {
  if (unit.empty() || unit == "%") return false;
  try {
    check_dimension(unit, "rad");
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

Config value_at(const Config& config, const std::string& path) {
  Config at = config;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    at = entry(at, path.substr(begin, end - begin), path);
    begin = end + 1;
  }
  return at;
}

bool has_value_at(const Config& config, const std::string& path) {
  try {
    value_at(config, path);
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

SceneParameter::SceneParameter(const Config& scene, const std::string& path) : path_(path) {
  const Config value = value_at(scene, path);
  if (value.is_scalar() && value.reads_as_number()) {
    number_ = value.number();
  } else {
    const auto quantity = value.is_scalar() ? split_quantity(value.text()) : std::nullopt;
    if (!quantity) value.fail(fmt::format("a parameter must be a number, found {}", value.shown()));
    number_ = quantity->number;
    unit_ = quantity->unit;
    try {
      factor_ = si_factor(unit_);
    } catch (const std::invalid_argument&) {
      value.fail(fmt::format("a parameter must be a number, found {}", value.shown()));
    }
    is_angle_ = is_unit_of_angles(unit_);
  }
  if (number_ == 0 && !is_angle_)
    value.fail(
        "a parameter of value 0 has no scale for a change: give it another value, or, if it is an angle, a unit");
}

double SceneParameter::usual_change() const { return is_angle_ ? std::numbers::pi / 180 : 0.01 * std::abs(value()); }

Config SceneParameter::changed(const Config& scene, double change) const {
  Config copy = scene.copy();
  this->change(copy, change);
  return copy;
}

void SceneParameter::change(Config& scene, double change) const {
  scene.set_yaml(path_, fmt::format("{:.17g}{}{}", number_ + change / factor_, unit_.empty() ? "" : " ", unit_),
                 "derivative with respect to " + path_);
}

}  // namespace orthodyn
