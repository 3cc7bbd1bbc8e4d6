#include "lib/material/presets.h"

namespace orthodyn {

namespace {

constexpr double kGiga = 1e9;

std::optional<double> given(double density) { return density > 0 ? std::optional(density) : std::nullopt; }

std::optional<Strength> strength_of(const WoodRow& row) {
  if (row.rupture == 0) return std::nullopt;
  constexpr double kMega = 1e6;
  return Strength{kMega * Vec3(row.rupture, row.tension_across, row.tension_across),
                  kMega * Vec3(row.compression_along, row.compression_across, row.compression_across),
                  kMega * row.shear_along * Vec3(1, kRollingShear, 1)};
}

Expansion shrinkage_of(const WoodRow& row) {
  const Vec3 percent(kShrinkageAlong, row.shrinkage_R, row.shrinkage_T);
  return {.moisture = Vec3(percent / (100 * kFibreSaturation)), .temperature = {}};
}

Preset wood(const WoodRow& row) {
  const double E = row.E_L * kGiga;
  return {row.name,
          {{E, row.E_R * E, row.E_T * E}, row.nu_LR, row.nu_RT, row.nu_LT, row.G_LR * E, row.G_RT * E, row.G_LT * E},
          given(row.density),
          strength_of(row),
          shrinkage_of(row),
          "1 = L along the grain, 2 = R radial, 3 = T tangential",
          "USDA Wood Handbook FPL-GTR-282, tables 4-3, 4-4, 5-1, 5-2, 5-3a, 12 % moisture"};
}

Preset composite(const CompositeRow& row) {
  const Vec3 young = kGiga * Vec3(row.E1, row.E2, row.E3);
  return {row.name,           {young, row.nu12, row.nu23, row.nu13, row.G12 * kGiga, row.G23 * kGiga, row.G13 * kGiga},
          given(row.density), std::nullopt,
          std::nullopt,       row.axes,
          row.source};
}

std::vector<Preset> convert() {
  std::vector<Preset> all;
  for (const auto& row : kWoodRows) all.push_back(wood(row));
  for (const auto& row : kCompositeRows) all.push_back(composite(row));
  return all;
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = convert();
  return all;
}

}  // namespace orthodyn
