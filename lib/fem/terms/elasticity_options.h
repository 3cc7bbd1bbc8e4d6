// Options of the elastic law, separate from the laws so that headers need not include them.
#pragma once

#include "lib/element/warped_tangent.h"

namespace orthodyn {

// automatic: the simulation chooses (lib/simulation/run/kinematics.h); a term with this value is corotational.
enum class Kinematics { corotational, linear, automatic };
enum class Corotation { exact, warped };

struct ElasticityOptions {
  Kinematics kinematics = Kinematics::corotational;
  Corotation corotation = Corotation::exact;
  WarpedTangent warped_tangent = WarpedTangent::rotated;

  // Whether the elastic force is warped: it then has no energy and may exert a net torque.
  bool is_warped() const { return kinematics != Kinematics::linear && corotation == Corotation::warped; }
  bool has_symmetric_tangent() const { return !(is_warped() && warped_tangent == WarpedTangent::unsymmetric); }
  bool has_exact_tangent() const { return !(is_warped() && warped_tangent == WarpedTangent::rotated); }
};

}  // namespace orthodyn
