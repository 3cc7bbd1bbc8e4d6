// What to do with constants whose stiffness is not positive definite: refuse them, or shrink what
// couples the strains by the largest common factor that makes it so. Never silently.
#pragma once

#include "lib/config/values.h"

namespace orthodyn {

enum class RatioRepair { none, shrink };

template <>
struct EnumNames<RatioRepair> {
  static constexpr std::array<std::pair<RatioRepair, const char*>, 2> list{
      {{RatioRepair::none, "none"}, {RatioRepair::shrink, "shrink"}}};
};

}  // namespace orthodyn
