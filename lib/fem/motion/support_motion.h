// Input of a prescribed motion: the nodes, their moved components, and their motion.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lib/config/formula.h"
#include "lib/config/values.h"
#include "lib/fem/motion/motion.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/selection.h"
#include "lib/ode/model.h"

namespace orthodyn {

enum class Component { x, y, z };

template <>
struct EnumNames<Component> {
  static constexpr std::array<std::pair<Component, const char*>, 3> list{
      {{Component::x, "x"}, {Component::y, "y"}, {Component::z, "z"}}};
};

// Returns a mask; mask[c] tells whether component c is in the list.
inline std::array<bool, 3> component_mask(const std::vector<Component>& components) {
  std::array<bool, 3> mask{};
  for (const Component c : components) mask[static_cast<std::size_t>(c)] = true;
  return mask;
}

struct Rotation {
  Vec3 point = Vec3::Zero(), axis{0, 0, 1};
  double angle = 0;  // rad
  static const Spec<Rotation>& spec();
};

// An entry of the list `motions`: a rigid motion with a factor in time, or formulas of the displacement.
struct SupportMotion : Selection {
  std::string name;
  std::vector<Component> components{Component::x, Component::y, Component::z};
  std::optional<Vec3> translation;  // m
  std::optional<Rotation> rotation;
  std::shared_ptr<const TimeFunction> factor;
  std::optional<std::array<TimePointFormula, 3>> displacement;  // m
  std::vector<double> kinks;                                    // s
  std::optional<double> resolution;                             // s
  static const Spec<SupportMotion>& spec();

  // Sets the traits of a model with moved supports.
  void declare(Traits& traits) const;

  // Motion from `start` to `end` (s) of points with rest positions X (m). Must not be evaluated before `start`.
  std::shared_ptr<const Motion> motion(double start, double end, const NodalVector& X) const;
};

}  // namespace orthodyn
