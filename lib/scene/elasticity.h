// The section `elasticity`: the elastic law of all elements.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "lib/config/spec.h"
#include "lib/fem/terms/elasticity_options.h"

namespace orthodyn {

template <>
struct EnumNames<Kinematics> {
  static constexpr std::array<std::pair<Kinematics, const char*>, 3> list{
      {{Kinematics::corotational, "corotational"}, {Kinematics::linear, "linear"}, {Kinematics::automatic, "auto"}}};
};

struct Elasticity : ElasticityOptions {
  std::optional<double> linear_error;  // relative to the largest displacement; for kinematics: auto only
  static const Spec<Elasticity>& spec();
};

}  // namespace orthodyn
