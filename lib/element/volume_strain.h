// The volume strain theta at a point, with its derivatives. For laws that rotate with the material theta = tr(S - I),
// for small strain theta = tr(H).
//
// In the notation of corotational_law.h, d theta = R : dF and d2 theta = w . G w = a . G^-1 a. Both are bounded in
// regular states (blend.h).
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

// For one point (T = double) or a batch.
template <class T>
struct VolumeStrain {
  T value;
  Mat3T<T> gradient;   // with respect to H, in material axes: R or Q
  Mat3T<T> curvature;  // the part Haa of d2 theta (tangent_form.h); zero in states that are not regular
};

}  // namespace orthodyn
