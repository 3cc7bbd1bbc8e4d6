// The first-order system of a model and its Jacobian in units of the tolerance, with the position scale s_q and the
// velocity scale s_v:
//
//   z = (q / u_q, v / u_v, t / u_t),   u_q = rtol s_q,   u_v = rtol s_v,   u_t = rtol s_q / s_v,
//   z' = F(z) = (v / u_q, M^-1 f / u_v, 1 / u_t),
//   J = dF/dz = (0, u_v/u_q, 0;  -u_q/u_v M^-1 K, -M^-1 D, u_t/u_v d(M^-1 f)/dt;  0, 0, 0).
//
// The last row and column exist only if f depends on time. An error of z with root mean square 1 is at the tolerance.
#pragma once

#include <vector>

#include "lib/ode/integrator.h"

namespace orthodyn {

class ScaledSystem {
 public:
  // `model` must outlive this object.
  ScaledSystem(const Model& model, double rtol, const Scales& scales);

  Eigen::Index size() const { return size_; }
  bool with_time() const { return size_ > 2 * n_; }

  // Computes F from v and a = M^-1 f.
  void rate(const Vector& v, const Vector& a, Vector& F) const;

  // Sets K and D at a state. If f depends on time, set_slope() must also set d(M^-1 f)/dt (m/s^3). Throws the model's
  // RecoverableError.
  void linearize(const State& at);
  void set_slope(const Vector& slope) { slope_ = slope; }

  // Computes y = J x. Precondition: linearize() has been called. Not thread-safe.
  void multiply(const Eigen::Ref<const Vector>& x, VectorRef y);  // y = J x

  // Adds a change z of the scaled unknowns to q and v.
  void move(const Vector& z, Vector& q, Vector& v) const;

  double rms(const Vector& z) const;
  std::size_t bytes() const;

 private:
  const Model& model_;
  double q_unit_, v_unit_, t_unit_;
  Eigen::Index n_, size_;
  Linearization linearization_;
  std::vector<double> stiffness_, damping_;
  bool damped_ = false;
  Vector slope_, force_, damping_force_;
};

}  // namespace orthodyn
