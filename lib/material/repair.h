// What to do with constants whose stiffness is not positive definite: refuse them, or shrink what
// couples the strains by the largest common factor that makes it so. Never silently.
#pragma once

#include "lib/core/values.h"

namespace orthodyn {

enum class Repair { none, shrink };

template <>
struct Words<Repair> {
  static constexpr std::array<std::pair<Repair, const char*>, 2> list{
      {{Repair::none, "none"}, {Repair::shrink, "shrink"}}};
};

}  // namespace orthodyn
