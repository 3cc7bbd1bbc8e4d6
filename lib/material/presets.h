// Materials by name: measured constants with their source.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/material/orthotropy.h"
#include "lib/material/preset_table.h"
#include "lib/material/strength.h"

namespace orthodyn {

struct Preset {
  std::string name;
  OrthotropicConstants constants;    // Pa
  std::optional<double> density;     // kg/m^3; none: the source has none
  std::optional<Strength> strength;  // likewise
  std::string axes;                  // what 1, 2, 3 are
  std::string source;
};

const std::vector<Preset>& presets();

// The index into presets().
enum class PresetName : int {};

template <>
struct EnumNames<PresetName> {
  static constexpr auto list = [] {
    std::array<std::pair<PresetName, const char*>, kWoodRows.size() + kCompositeRows.size()> words{};
    int i = 0;
    const auto add = [&](const char* name) {
      words[static_cast<std::size_t>(i)] = {static_cast<PresetName>(i), name};
      ++i;
    };
    for (const auto& row : kWoodRows) add(row.name);
    for (const auto& row : kCompositeRows) add(row.name);
    return words;
  }();
};

}  // namespace orthodyn
