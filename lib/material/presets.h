// Presets: measured constants of named materials, with their sources.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/material/expansion.h"
#include "lib/material/orthotropy.h"
#include "lib/material/preset_table.h"
#include "lib/material/strength.h"

namespace orthodyn {

struct Preset {
  std::string name;
  OrthotropicConstants constants;      // Pa
  std::optional<double> density;       // kg/m^3; none if the source gives none
  std::optional<Strength> strength;    // none if the source gives none
  std::optional<Expansion> expansion;  // none if the source gives none
  std::string axes;                    // meaning of 1, 2, 3
  std::string source;
};

const std::vector<Preset>& presets();

// A preset as its index into presets().
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
