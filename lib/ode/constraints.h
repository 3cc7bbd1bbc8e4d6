// Algebraic constraints of a model: M q'' = f - G^T lambda, g(t, q) = 0, G = dg/dq, with m multipliers lambda.
//
// Thread safety as for Model. g is in m for a mechanical model, lambda in N.
#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "lib/core/types.h"

namespace orthodyn {

class Constraints {
 public:
  virtual ~Constraints() = default;
  virtual int size() const = 0;  // m
  // What a constraint holds, for messages: "joint hip, x".
  virtual std::string name(int constraint) const = 0;

  virtual void values(double t, const ConstVectorRef& q, VectorRef g) const = 0;
  // The transpose of G, n x m.
  virtual Eigen::SparseMatrix<double> jacobian(double t, const ConstVectorRef& q) const = 0;
  // dg/dt = G v + (partial derivative by t).
  virtual void rates(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const = 0;
  // The second derivative of g by t without accelerations: d2g/dt2 = G a + c.
  virtual void curvature(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef c) const = 0;
};

}  // namespace orthodyn
