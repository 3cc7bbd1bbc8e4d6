// Measured orthotropic constants as printed in their sources; presets.h converts them.
//
// Wood: USDA Forest Service, Wood Handbook, FPL-GTR-282 (2021), tables 5-1 (ratios of moduli), 5-2
// (Poisson's ratios) and 5-3a (modulus of elasticity in bending, increased by 10 % as the book says, and
// specific gravity), at 12 % moisture content. Axes: 1 = L, along the grain; 2 = R, radial; 3 = T,
// tangential. The larger Poisson's ratio of each pair is used: the book's nu_RL, nu_TL, nu_TR are less accurate and
// violate the symmetry of the compliance by up to 113 %.
//
// Strengths are from table 5-3a at 12 %: averages of a species for clear wood. Tension along the grain is the modulus
// of rupture, which the book uses as a conservative value. Compression across the grain is at the proportional limit.
// The table does not distinguish R and T. According to the book, rolling shear (plane 2-3) is 18 to 28 % of the shear
// along the grain; the smaller value is used.
//
// Shrinkage from green to oven-dry wood is from tables 4-3 and 4-4. The handbook takes it as proportional to the
// moisture content below the fibre saturation at 30 %. Along the grain it gives 0.1 to 0.2 %; the mean is used.
#pragma once

#include <array>

namespace orthodyn {

struct WoodRow {
  const char* name;
  double E_L;                         // GPa
  double E_R, E_T, G_LR, G_LT, G_RT;  // relative to E_L
  double nu_LR, nu_LT, nu_RT;
  double density;  // kg/m^3; 0: not in the tables
  // MPa; 0: not in the tables
  double rupture = 0, compression_along = 0, compression_across = 0, shear_along = 0, tension_across = 0;
  double shrinkage_R = 0, shrinkage_T = 0;  // %, from green to oven-dry
};

inline constexpr double kShrinkageAlong = 0.15;  // %, from green to oven-dry
inline constexpr double kFibreSaturation = 30;   // % of moisture content
inline constexpr double kRollingShear = 0.18;    // relative to shear along the grain

inline constexpr std::array<WoodRow, 10> kWoodRows{{
    {"sitka_spruce", 11.88, 0.078, 0.043, 0.064, 0.061, 0.003, 0.372, 0.467, 0.435, 448, 70, 38.7, 4.0, 7.9, 2.6, 4.3,
     7.5},
    {"douglas_fir", 14.74, 0.068, 0.050, 0.064, 0.078, 0.007, 0.292, 0.449, 0.390, 537.6, 85, 49.9, 5.5, 7.8, 2.3, 4.8,
     7.6},
    {"engelmann_spruce", 9.79, 0.128, 0.059, 0.124, 0.120, 0.010, 0.422, 0.462, 0.530, 392, 64, 30.9, 2.8, 8.3, 2.4,
     3.8, 7.1},
    {"yellow_poplar", 11.99, 0.092, 0.043, 0.075, 0.069, 0.011, 0.318, 0.392, 0.703, 470.4, 70, 38.2, 3.4, 8.2, 3.7,
     4.6, 8.2},
    {"yellow_birch", 15.29, 0.078, 0.050, 0.074, 0.068, 0.017, 0.426, 0.451, 0.697, 694.4, 114, 56.3, 6.7, 13.0, 6.3,
     7.3, 9.5},
    {"black_walnut", 12.76, 0.106, 0.056, 0.085, 0.062, 0.021, 0.495, 0.632, 0.718, 616, 101, 52.3, 7.0, 9.4, 4.8, 5.5,
     7.8},
    {"sweetgum", 12.43, 0.115, 0.050, 0.089, 0.061, 0.021, 0.325, 0.403, 0.682, 582.4, 86, 43.6, 4.3, 11.0, 5.2, 5.3,
     10.2},
    {"balsa", 3.74, 0.046, 0.015, 0.054, 0.037, 0.005, 0.229, 0.488, 0.665, 0, 0, 0, 0, 0, 0, 3.0, 7.6},
    {"honduras_mahogany", 11.33, 0.107, 0.064, 0.066, 0.086, 0.028, 0.314, 0.533, 0.600, 0, 0, 0, 0, 0, 0, 3.0, 4.1},
    {"african_mahogany", 10.67, 0.111, 0.050, 0.088, 0.059, 0.021, 0.297, 0.641, 0.604, 0, 0, 0, 0, 0, 0, 2.5, 4.5},
}};

struct CompositeRow {
  const char* name;
  double E1, E2, E3, G12, G23, G13;  // GPa
  double nu12, nu23, nu13;
  double density;  // kg/m^3; 0: not given
  const char* axes;
  const char* source;
};

inline constexpr std::array<CompositeRow, 2> kCompositeRows{{
    {"cfrp_ud", 109, 8.819, 8.819, 4.315, 3.200, 4.315, 0.342, 0.380, 0.342, 0, "1 along the fibres",
     "Manufacturing Review 2020, article 190034, table 2"},
    {"nafems_hoop_winding", 130, 5, 5, 10, 5, 10, 0.25, 0, 0.25, 0, "1 along the winding (hoop)",
     "NAFEMS R0031/2, wrapped cylinder (data of a benchmark)"},
}};

}  // namespace orthodyn
