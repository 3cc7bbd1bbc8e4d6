// Which elastic law the elements have, as plain options: the laws themselves are behind elastic_term.h.
#pragma once

#include "lib/element/warped_tangent.h"

namespace orthodyn {

// automatic: one of the others, as the simulation finds (lib/simulation/run/kinematics.h); by itself corotational.
enum class Kinematics { corotational, linear, automatic };
enum class Corotation { exact, warped };

struct ElasticityOptions {
  Kinematics kinematics = Kinematics::corotational;
  Corotation corotation = Corotation::exact;
  WarpedTangent warped_tangent = WarpedTangent::rotated;

  // Whether the elastic force has no energy: it is neither conservative nor free of a net torque.
  bool is_warped() const { return kinematics != Kinematics::linear && corotation == Corotation::warped; }
  bool has_symmetric_tangent() const { return !(is_warped() && warped_tangent == WarpedTangent::unsymmetric); }
  bool has_exact_tangent() const { return !(is_warped() && warped_tangent == WarpedTangent::rotated); }
};

}  // namespace orthodyn
