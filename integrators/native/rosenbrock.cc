// A Rosenbrock method for y' = f(t, y) that permits any matrix W instead of the Jacobian (ros34pw2.h), in the form
// without products by the Jacobian (Hairer & Wanner 1996, IV.7). With u = Gamma k, where Gamma is the matrix of the
// gamma_ij, gamma_i its row sums and gamma its diagonal entry,
//
//   (I - gamma h W) u_i = gamma (h f(t_i, y0 + sum_j a_ij u_j) + sum_j c_ij u_j + gamma_i h^2 df/dt)
//   y1 = y0 + sum_j m_j u_j.
//
// At the end of the step, correct() adds one Newton correction.
#include "integrators/native/linearly_implicit.h"
#include "integrators/native/ros34pw2.h"
#include "integrators/native/time_difference.h"

namespace orthodyn {
namespace {

constexpr int kStages = 4;

// The error test uses rtol divided by this; otherwise errors of rotating stiff bodies accumulate (docs/decisions.md).
constexpr double kStrictness = 10;

LinearOptions stricter(LinearOptions options) {
  options.rtol /= kStrictness;
  return options;
}

// The coefficients for u = Gamma k.
struct TransformedTable {
  Eigen::Matrix4d a, c;
  Eigen::Vector4d m, error, t, gamma;  // stage times are t0 + t[i] h; gamma[i] = gamma_i
  Eigen::Vector4d slope;               // gives h y' at the end, the last k, since the method is stiffly accurate

  TransformedTable() {
    const Ros34Pw2 given;
    const Eigen::Matrix4d inverse = given.gamma.inverse();
    a = given.alpha * inverse;
    c = -inverse;
    c.diagonal().setZero();
    m = inverse.transpose() * given.b;
    error = inverse.transpose() * (given.b - given.embedded);
    t = given.alpha.rowwise().sum();
    gamma = given.gamma.rowwise().sum();
    slope = inverse.row(3).transpose();
  }
};

class Rosenbrock : public LinearlyImplicit {
 public:
  Rosenbrock(const Model& model, const LinearOptions& options, const Scales& scales, int tangent_steps)
      : LinearlyImplicit("rosenbrock", model, stricter(options), scales, tangent_steps),
        u_q_(model.num_dofs(), kStages),
        u_v_(model.num_dofs(), kStages),
        f_(model.num_dofs()),
        p_(model.num_dofs()),
        f_t_(Vector::Zero(model.num_dofs())),
        c_q_(model.num_dofs()),
        c_v_(model.num_dofs()) {}

 protected:
  Orders orders() const override { return {3, 3}; }

  bool attempt(double h) override {
    if (!prepare(Ros34Pw2::kGamma * h)) return false;
    if (model_.traits().time_dependent) differentiate_in_time(h);
    for (int i = 0; i < kStages; ++i) solve_stage(i, h);
    next_.q = now().q + u_q_ * table_.m;
    next_.v = now().v + u_v_ * table_.m;
    correct(h);
    finish((u_v_ * table_.slope + c_v_ / Ros34Pw2::kGamma) / h);
    return true;
  }

  // Adds the size of the correction, because the embedded method does not detect the error that the correction removes.
  void estimate(double, VectorRef e_q, VectorRef e_v) override {
    e_q = c_q_.cwiseAbs() + (u_q_ * table_.error).cwiseAbs();
    e_v = c_v_.cwiseAbs() + (u_v_ * table_.error).cwiseAbs();
  }

  std::size_t method_bytes() const override {
    return LinearlyImplicit::method_bytes() + (2 * kStages + 5) * static_cast<std::size_t>(f_.size()) * sizeof(double);
  }

 private:
  void solve_stage(int i, double h) {
    const Eigen::Vector4d a = table_.a.row(i), c = table_.c.row(i);
    next_.q = now().q + u_q_.leftCols(i) * a.head(i);
    next_.v = now().v + u_v_.leftCols(i) * a.head(i);
    if (i == 0) f_ = force_now();
    else force(now().t + table_.t[i] * h, next_.q, next_.v, f_);
    model_.multiply_mass(u_v_.leftCols(i) * c.head(i), p_);
    p_ = Ros34Pw2::kGamma * (h * f_ + p_ + table_.gamma[i] * h * h * f_t_);
    u_q_.col(i) = Ros34Pw2::kGamma * (h * next_.v + u_q_.leftCols(i) * c.head(i));
    solve_.solve(u_q_.col(i), p_, u_q_.col(i), u_v_.col(i));
  }

  // The stages are linear. If the force of stiff modes is nonlinear, as in a rotating body, the acceleration of the
  // last stage does not balance the force at the end. This Newton correction restores the balance and keeps the order
  // of the method. Without it a pendulum with an energy of 50 J, held at one node, gained 1,000 J at rtol 1e-3; with
  // it, 1.7 J.
  void correct(double h) {
    force(next_.t, next_.q, next_.v, f_);
    model_.multiply_mass(u_v_ * table_.slope, p_);
    p_ = Ros34Pw2::kGamma * (h * f_ - p_);
    c_q_.setZero();
    solve_.solve(c_q_, p_, c_q_, c_v_);
    next_.q += c_q_;
    next_.v += c_v_;
  }

  void differentiate_in_time(double h) {
    const double t = now().t, later = shortly_after(t, h);
    force(later, now().q, now().v, f_t_);
    f_t_ = (f_t_ - force_now()) / (later - t);
  }

  const TransformedTable table_;
  Eigen::MatrixXd u_q_, u_v_;       // a column per stage
  Vector f_, p_, f_t_, c_q_, c_v_;  // c_q_, c_v_: the correction
};

class RosenbrockChoice : public SettableChoice<RosenbrockChoice>, public LinearOptions {
 public:
  int tangent_steps = 1;

  static const Spec<RosenbrockChoice>& spec() {
    using C = RosenbrockChoice;
    static const auto s =
        LinearOptions::spec_for<C>().key("tangent_steps", &C::tangent_steps,
                                         "Steps for which a tangent is kept; a failed step renews it.", {.range = {1}});
    return s;
  }
  static MethodFacts facts() {
    return method_facts("3", "L-stable with the tangent of each step", "momentum",
                        "ROS34PW2 (Rang & Angermann 2005) with one Newton correction at the end; error estimate: "
                        "embedded order 2 and the correction, at rtol/10");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<Rosenbrock>(model, *this, scales(task), tangent_steps);
  }
};

const bool rosenbrock_registered = Registry<IntegratorChoice>::add<RosenbrockChoice>(
    "rosenbrock",
    "Rosenbrock method of order 3 that permits old or inexact tangents: five linear solves per step, no iteration.");

}  // namespace
}  // namespace orthodyn
