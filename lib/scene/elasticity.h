// The elastic law of all elements, the section `elasticity`.
#pragma once

#include <optional>

#include "lib/config/spec.h"
#include "lib/fem/terms/elasticity_options.h"

namespace orthodyn {

struct Elasticity : ElasticityOptions {
  std::optional<double> linear_error;  // allowed with kinematics: auto
  static const Spec<Elasticity>& spec();
};

}  // namespace orthodyn
