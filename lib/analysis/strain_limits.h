// Strain limits of the corotational law: the strains along each material axis under uniaxial stress at which the law
// loses strong ellipticity.
//
// Beyond a limit, waves of some direction have no real speed, and deformation localises in single elements of any mesh.
// Let sigma_i be the stress and e the strain along axis i, j another axis, s_i = 1 + e and s_j = 1 - nu_ij e the
// stretches, nu_ij Poisson's ratio, mu_ij the shear modulus, and a_i, a_j unit vectors along the axes. The limits are
//     compression, dF = a_j (x) a_i:  4 mu_ij s_j^2 + sigma_i (2 s_j + s_i) = 0   (fibres kink),
//     tension,     dF = a_i (x) a_j:  4 mu_ij = sigma_i / s_i                     (layers slide).
// These are zeros of the second variation (corotational_law.h) for the given rank-one changes dF of the deformation
// gradient. The compressive limit is fibre buckling; the tensile limit is a property of this law, whose rotation R does
// not follow the fibre. In addition, the cross section vanishes at e = 1 / nu_ij.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lib/element/tangent_form.h"

namespace orthodyn {

enum class LimitKind { kink, slide, flat, oblique };

struct StrainLimit {
  double strain;  // along the axis: negative in compression
  LimitKind kind;
  int plane;  // the other axis, 0 to 2; meaningless for `oblique`
};

// The limits closest to zero strain. `compression` is empty if the law holds down to strain -1, `tension` if it holds
// for any tension.
struct AxisLimits {
  std::optional<StrainLimit> compression, tension;
};

// Limits for the axes 1, 2, 3. A fully anisotropic body shears under uniaxial stress. Its limits are therefore searched
// with the acoustic tensor between -95 % and +100 % strain, to three digits, and have the kind `oblique`.
std::array<AxisLimits, 3> strain_limits(const Stiffness& stiffness);

// Maps a Voigt strain to sigma_i / E_i (i = 1, 2, 3), the strain that the stress sigma_i alone would cause. Compare
// this value with the limits, not the strain along axis i, because the contraction under tension along another axis is
// harmless.
Mat36 stress_over_young(const Stiffness& stiffness);

// Text for messages, such as "kinks in the plane 1-2". `axis`: 0 to 2.
std::string describe(const StrainLimit& limit, int axis);

}  // namespace orthodyn
