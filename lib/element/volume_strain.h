// The volume strain theta of a law at a point, with its derivatives: tr(S - I) of laws that rotate with the material,
// tr(H) of small strain.
//
// With the notation of corotational_law.h, d theta = R : dF and d2 theta = w . G w = a . G^-1 a. Both are bounded where
// the polar decomposition is regular, whatever the material.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

// For one point (T = double) or a batch.
template <class T>
struct VolumeStrain {
  T value;
  Mat3T<T> gradient;   // with respect to H, in material axes: R or Q
  Mat3T<T> curvature;  // the part Haa of d2 theta (tangent_form.h); zero where it is unbounded
};

}  // namespace orthodyn
