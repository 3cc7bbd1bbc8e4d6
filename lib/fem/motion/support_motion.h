// A prescribed motion in the words of the input: nodes, which of their coordinates, and how they move.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "lib/config/formula.h"
#include "lib/fem/motion/component.h"
#include "lib/fem/motion/motion.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/selection.h"
#include "lib/ode/model.h"

namespace orthodyn {

struct Rotation {
  Vec3 point = Vec3::Zero(), axis{0, 0, 1};
  double angle = 0;  // rad
  static const Spec<Rotation>& spec();
};

// Either a rigid motion by one factor in time, or formulas of the displacement.
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

  // What changes for integrators when supports are moved.
  void declare(Traits& traits) const;

  // Between two times, s, before the first of which it is never asked for; of the points X at rest, m.
  std::shared_ptr<const Motion> motion(double start, double end, const NodalVector& X) const;
};

}  // namespace orthodyn
