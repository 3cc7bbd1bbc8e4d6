// An entry of the list `loads`: either a dead traction on a surface, which may depend on the rest position, or a total
// force that is spread evenly over the surface.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "lib/config/formula.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

struct Load : TermChoice {
  std::string surface;
  std::optional<std::array<PointQuantity, 3>> traction;  // Pa, per undeformed area
  std::optional<Vec3> force;                             // total, N
  std::shared_ptr<const TimeFunction> factor;
  SourceLocation origin;
  static const Spec<Load>& spec();

  std::unique_ptr<Term> make(const Discretization& body) const override;
  const TimeFunction* factor_in_time() const override { return factor.get(); }
  void declare(Traits& traits) const override;
};

}  // namespace orthodyn
