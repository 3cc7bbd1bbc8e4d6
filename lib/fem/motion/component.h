// A coordinate of a node, in the words of the input.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "lib/config/values.h"

namespace orthodyn {

enum class Component { x, y, z };

template <>
struct EnumNames<Component> {
  static constexpr std::array<std::pair<Component, const char*>, 3> list{
      {{Component::x, "x"}, {Component::y, "y"}, {Component::z, "z"}}};
};

// Which of the three coordinates are among these.
inline std::array<bool, 3> component_mask(const std::vector<Component>& components) {
  std::array<bool, 3> mask{};
  for (const Component c : components) mask[static_cast<std::size_t>(c)] = true;
  return mask;
}

}  // namespace orthodyn
