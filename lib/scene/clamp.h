// Nodes that do not move, in all coordinates or in some: an entry of the list `clamps`.
#pragma once

#include <string>
#include <vector>

#include "lib/fem/motion/component.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

struct Clamp : Selection {
  std::string name;
  std::vector<Component> components{Component::x, Component::y, Component::z};
  static const Spec<Clamp>& spec();
};

}  // namespace orthodyn
