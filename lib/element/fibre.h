// The stretch and the stress of a fibre along material axis 1, per lane.
//
// With f = F Q e1, the stretch lambda = |f| and the direction n = f / lambda, a nominal tension T (Pa) has the first
// Piola-Kirchhoff stress P = T n (Q e1)^T: its work is T dlambda, and P Q has only its first column T n. With linear
// kinematics lambda = 1 + e11, with the small strain e11, and n = Q e1.
#pragma once

#include "lib/element/strain.h"
#include "lib/element/tangent_form.h"

namespace orthodyn {

struct Fibre {
  Batch x;           // lambda - 1, to a few ulp
  Batch per_length;  // 1 / lambda; 0 with linear kinematics, where n is fixed
  Vec3T<Batch> n;

  // H, Q as in corotational_law.h. Throws RecoverableError if lambda is zero or not finite, except with linear
  // kinematics.
  Fibre(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, bool is_linear);

  // P Q.
  Mat3T<Batch> stress(const Batch& tension) const;

  // dlambda/dt for dF/dt Q.
  Batch rate(const Mat3T<Batch>& F_rate) const { return n.dot(F_rate.col(0)); }

  // Adds d(P Q)/d(H Q) for the tension T, with `slope` = dT/dlambda.
  void add_moduli(const Batch& tension, const Batch& slope, Mat9T<Batch>& K) const;

  // For `viscosity` = dT/d(dlambda/dt) (Pa s): adds d(P Q)/d(dF/dt Q) to D, and the symmetric part of the change of the
  // stress by that of dlambda/dt with F, at a fixed dF/dt, to K.
  void add_viscosity(const Batch& viscosity, Mat9T<Batch>& D) const;
  void add_turning(const Batch& viscosity, const Mat3T<Batch>& F_rate, Mat9T<Batch>& K) const;
};

// The mean stress P Q between two states of a fibre, for the mean tension between lambda0 and lambda1: the work
// P : (F1 - F0) is that of the tension, and P (F0 + F1)^T is symmetric.
Mat3T<Batch> mean_fibre_stress(const Fibre& fibre0, const Fibre& fibre1, const Batch& mean_tension);

}  // namespace orthodyn
