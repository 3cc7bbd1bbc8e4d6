// The equations of forward sensitivities: the derivatives s = dq/dp of a motion with respect to parameters p of its
// model, where M q'' = f(t, q, q', p).
//
//   M s'' = -K s - D s' + g,   g = df/dp - (dM/dp) q'',   K = -df/dq,   D = -df/dv
//
// Units: for a mechanical model, s is in m and s' in m/s, per SI unit of the parameter. Model gives all other units.
//
// Source: Maly & Petzold (1996), Appl. Numer. Math. 20, 57-79.
#pragma once

#include "lib/core/types.h"
#include "lib/ode/output.h"

namespace orthodyn {

class SensitivityEquations {
 public:
  virtual ~SensitivityEquations() = default;

  // The number of parameters.
  virtual int count() const = 0;

  // A change of parameter i, for error control: the change of the motion that follows from it has the tolerances of the
  // motion itself.
  virtual double scale(int i) const = 0;

  // The derivative of the initial state with respect to parameter i; `t` is the initial time.
  virtual const State& initial(int i) const = 0;

  // Computes M s'' = -K s - D s' + g of parameter i at a state of the motion: t, q, v and the acceleration a = q''. All
  // vectors have the model's size. Calls at the same state share the derivatives of f. Throws RecoverableError as
  // Model::force() does.
  virtual void force(int i, double t, const ConstVectorRef& q, const ConstVectorRef& v, const ConstVectorRef& a,
                     const ConstVectorRef& s, const ConstVectorRef& s_dot, VectorRef out) = 0;
};

}  // namespace orthodyn
