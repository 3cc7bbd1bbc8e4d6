// The elastic law of all elements, the section `elasticity`.
#pragma once

#include "lib/config/spec.h"
#include "lib/fem/terms/elasticity_options.h"

namespace orthodyn {

struct Elasticity : ElasticityOptions {
  static const Spec<Elasticity>& spec();
};

}  // namespace orthodyn
