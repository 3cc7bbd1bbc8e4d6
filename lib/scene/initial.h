// The section `initial`: the initial state. The displacement is the sum of a uniform deformation about `center`,
// formulas and noise; the velocity is the sum of a rigid motion and formulas.
#pragma once

#include <array>
#include <optional>

#include "lib/config/formula.h"
#include "lib/config/spec.h"
#include "lib/ode/output.h"

namespace orthodyn {

class FemModel;

struct Noise {
  double amplitude = 0;  // m
  long seed = 1;
  static const Spec<Noise>& spec();
};

struct Initial {
  Vec3 velocity = Vec3::Zero();                                   // m/s
  Vec3 spin = Vec3::Zero();                                       // rad/s
  std::optional<std::array<PointFormula, 3>> velocity_field;      // m/s, function of the rest position
  std::optional<Vec3> center;                                     // m; default the centre of mass
  std::optional<Mat3> deformation_gradient;                       // about `center`
  std::optional<std::array<PointFormula, 3>> displacement_field;  // m, function of the rest position
  std::optional<Noise> noise;
  SourceLocation origin;
  static const Spec<Initial>& spec();
};

// The initial state at `time` (s); without `initial`, the undeformed body at rest. Its velocities may violate joints.
State initial_state(const std::optional<Initial>& initial, double time, const FemModel& model);

// The state at `time` (s) with free coordinates q (m) and the initial velocities.
State initial_state_at(const Vector& q, const std::optional<Initial>& initial, double time, const FemModel& model);

}  // namespace orthodyn
