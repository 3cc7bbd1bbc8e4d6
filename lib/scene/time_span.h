// The time that a scene covers, the section `time`.
#pragma once

#include "lib/config/spec.h"

namespace orthodyn {

struct TimeSpan {
  double start = 0, end = 0;  // s
  static const Spec<TimeSpan>& spec();
};

}  // namespace orthodyn
