// The section `elasticity`: kinematics of the elastic law. A region may override the kinematics.
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
  std::optional<double> linear_error;  // allowed error of kinematics: auto, relative to the largest displacement
  static const Spec<Elasticity>& spec();
};

}  // namespace orthodyn
