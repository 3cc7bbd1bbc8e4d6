// How far a corotational body may be stretched along one of its material axes, under stress along that
// axis alone, before the law itself gives way.
//
// The law loses strong ellipticity (waves of some direction stop travelling: deformation then localises
// at the size of an element, whatever the mesh) at the stress sigma_i along axis i where, for some other
// axis j with stretches s_i = 1 + e, s_j = 1 - nu_ij e and shear modulus mu_ij,
//     compression, dF = e_j (x) e_i:  4 mu_ij s_j^2 + sigma_i (2 s_j + s_i) = 0   (fibres kink),
//     tension,     dF = e_i (x) e_j:  4 mu_ij = sigma_i / s_i                     (layers slide).
// These are zeros of the second variation (corotational_law.h) on rank-one changes. The compressive one
// is the buckling of the fibre; the tensile one is a property of this law, whose rotation R does not
// follow the fibre. Besides, the section has no thickness left at e = 1 / nu_ij.
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
  int plane;  // the other axis, 0 to 2; meaningless where oblique
};

// The limits nearest to rest; none where the law holds down to strain -1 or up to any.
struct AxisLimits {
  std::optional<StrainLimit> compression, tension;
};

// For the axes 1, 2, 3. Of a fully anisotropic C, which shears under stress along an axis, the limits are
// searched for by the acoustic tensor (acoustic.h), between -95 % and +100 %, to three digits: `oblique`.
std::array<AxisLimits, 3> strain_limits(const Stiffness& stiffness);

// Maps a strain in Voigt form to sigma_i / E_i for i = 1, 2, 3: the strain along axis i that stress along i
// alone would need. It is what the limits are to be compared with: a contraction that goes with tension along
// another axis is harmless.
Mat36 stress_over_young(const Stiffness& stiffness);

// "kinks in the plane 1-2"
std::string describe(const StrainLimit& limit, int axis);

}  // namespace orthodyn
