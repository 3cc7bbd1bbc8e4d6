// A number of a scene as a parameter, by its path in the file: "materials.spruce.young.0", "regions.body.axes.angle".
#pragma once

#include <string>

#include "lib/config/config.h"

namespace orthodyn {

// The value at a path of keys and indices, such as "young.0". Throws ConfigError if there is none.
Config value_at(const Config& config, const std::string& path);

// Whether there is a value at the path.
bool has_value_at(const Config& config, const std::string& path);

class SceneParameter {
 public:
  // Throws ConfigError if the scene has no such key, if it is not a number, or if it is 0 and not an angle, so that
  // there is no scale for a change.
  SceneParameter(const Config& scene, const std::string& path);

  const std::string& path() const { return path_; }
  double value() const { return number_ * factor_; }  // in SI units
  const std::string& unit() const { return unit_; }   // as written; "" for a number without a unit
  double factor() const { return factor_; }           // from unit() to SI
  bool is_angle() const { return is_angle_; }

  // A usual change in SI units, and its text: 1 % of the value, or 1 degree of an angle.
  double usual_change() const;
  const char* change_text() const { return is_angle_ ? "1 deg" : "1 %"; }

  // The scene with this parameter larger by `change` (SI units). The scene is not changed.
  Config changed(const Config& scene, double change) const;
  // Changes the parameter of the scene itself.
  void change(Config& scene, double change) const;

 private:
  std::string path_, unit_;
  double number_ = 0, factor_ = 1;  // as written, and the unit in SI units
  bool is_angle_ = false;
};

}  // namespace orthodyn
