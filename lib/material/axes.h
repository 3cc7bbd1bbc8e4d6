// The material axes in space: a proper rotation whose columns are the directions 1, 2, 3.
#pragma once

#include "lib/core/spec.h"

namespace orthodyn {

// Axis 1 is `first`, axis 2 the part of `second` normal to it (Gram-Schmidt), axis 3 = 1 x 2.
struct Axes {
  Vec3 first{1, 0, 0}, second{0, 1, 0};

  static const Spec<Axes>& spec();
  Mat3 rotation() const;
};

}  // namespace orthodyn
