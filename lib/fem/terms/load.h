// An entry of a scene's list `loads`: a dead traction on a surface, which may depend on the position, or a total force
// that is spread evenly over it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "lib/config/point_quantity.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

struct Load : TermChoice {
  std::string surface;
  std::optional<std::array<PointQuantity, 3>> traction;  // Pa, per undeformed area
  std::optional<Vec3> force;                             // N in total
  std::shared_ptr<const TimeFunction> factor;
  SourceLocation origin;
  static const Spec<Load>& spec();

  std::unique_ptr<Term> make(const Discretization& body) const override;
  void declare(Traits& traits) const override;
};

}  // namespace orthodyn
