// Small models whose solutions are known exactly.
#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

using Matrix = Eigen::MatrixXd;

// A model of a few unknowns with full matrices.
class SmallModel : public Model, public DiscreteGradient {
 public:
  int num_dofs() const override { return static_cast<int>(mass_.rows()); }
  const Traits& traits() const override { return traits_; }
  const Pattern& pattern() const override { return pattern_; }

  void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                 Linearization& out) const override {
    out.stiffness.resize(pattern_.row.size());
    gather(stiffness(t, q, v, kind), out.stiffness.data());
    if (!traits_.damping_matrix) return;
    out.damping.resize(pattern_.row.size());
    gather(damping(q), out.damping.data());
  }
  void combine(const Weights& w, const Linearization& at, double* values) const override {
    gather(w.mass * mass_, values);
    for (std::size_t k = 0; k < at.stiffness.size(); ++k) values[k] += w.stiffness * at.stiffness[k];
    for (std::size_t k = 0; k < at.damping.size(); ++k) values[k] += w.damping * at.damping[k];
  }
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { y = mass_ * x; }
  void solve_mass(VectorRef x) const override { x = mass_.llt().solve(Vector(x)); }

  // Two halves of the whole force, named as two parts of a body's are.
  std::vector<std::string> force_parts() const override { return {"gravity", "elasticity"}; }
  std::unique_ptr<Model> only(const std::vector<std::string>& parts) const override;

  const DiscreteGradient* discrete_gradient() const override { return this; }
  // That of the middle: exact where the energy is quadratic.
  void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1, const ConstVectorRef& v,
                  VectorRef f) const override {
    force(0.5 * (t0 + t1), 0.5 * (q0 + q1), v, f);
  }

  virtual State initial() const = 0;
  virtual double end() const = 0;
  virtual Scales scales() const { return {1, 1}; }

 protected:
  explicit SmallModel(const Matrix& mass, bool symmetric = true) : mass_(mass) {
    const int n = static_cast<int>(mass.rows());
    pattern_.n = n;
    pattern_.symmetric = symmetric;
    for (int j = 0; j < n; ++j) {
      pattern_.column_start.push_back(pattern_.non_zeros());
      for (int i = symmetric ? j : 0; i < n; ++i) pattern_.row.push_back(i);
    }
    pattern_.column_start.push_back(pattern_.non_zeros());
    traits_.lumped_mass = mass.isDiagonal();
  }

  virtual Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const = 0;
  virtual Matrix damping(const Vector&) const { return Matrix::Zero(num_dofs(), num_dofs()); }

  Matrix mass_;
  Traits traits_;

 private:
  friend class Share;

  void gather(const Matrix& full, double* values) const {
    for (int j = 0; j < pattern_.n; ++j)
      for (int i = pattern_.symmetric ? j : 0; i < pattern_.n; ++i) *values++ = full(i, j);
  }

  Pattern pattern_;
};

// A share of another model's force.
class Share : public SmallModel {
 public:
  Share(const SmallModel& whole, double share)
      : SmallModel(whole.mass_, whole.pattern().symmetric), whole_(whole), share_(share) {
    traits_ = whole.traits();
  }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    whole_.force(t, q, v, f);
    f *= share_;
  }
  State initial() const override { return whole_.initial(); }
  double end() const override { return whole_.end(); }

 private:
  Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const override {
    return share_ * whole_.stiffness(t, q, v, kind);
  }
  Matrix damping(const Vector& q) const override { return share_ * whole_.damping(q); }

  const SmallModel& whole_;
  double share_;
};

inline std::unique_ptr<Model> SmallModel::only(const std::vector<std::string>& parts) const {
  return std::make_unique<Share>(*this, 0.5 * static_cast<double>(parts.size()));
}

// M q'' + (beta K) q' + K q = s(t) b with s piecewise linear: solved exactly, mode by mode.
class LinearModel : public SmallModel {
 public:
  struct Given {
    Matrix mass, stiffness;
    double beta = 0;                                 // s
    Vector load = {};                                // N; none if empty
    std::vector<std::array<double, 2>> factor = {};  // times and values; constant beyond its ends
    Vector start = {};                               // q(0); v(0) = 0
    double end = 1;                                  // s
    double velocity_scale = 1;
  };

  explicit LinearModel(const Given& given)
      : SmallModel(given.mass, given.stiffness.isApprox(given.stiffness.transpose(), 0)), given_(given) {
    traits_.linear = true;
    traits_.damped = traits_.damping_matrix = given.beta > 0;
    traits_.time_dependent = given.load.size() > 0;
    traits_.conservative = !traits_.damped && !traits_.time_dependent;
    if (!given_.start.size()) given_.start = Vector::Zero(given.mass.rows());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> modes(given.stiffness, given.mass);
    shapes_ = modes.eigenvectors();  // V^T M V = I
    omega_squared_ = modes.eigenvalues();
  }

  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    f = -given_.stiffness * (q + given_.beta * v);
    if (given_.load.size()) f += factor(t) * given_.load;
  }
  std::vector<double> breakpoints(double start, double end) const override {
    std::vector<double> times;
    for (const auto& [t, value] : given_.factor)
      if (t > start && t < end) times.push_back(t);
    return times;
  }

  State initial() const override { return {0, given_.start, Vector::Zero(num_dofs())}; }
  double end() const override { return given_.end; }
  Scales scales() const override { return {1, given_.velocity_scale}; }

  State exact(double t) const {
    Vector z = shapes_.transpose() * mass_ * given_.start, w = Vector::Zero(num_dofs());
    double from = 0;
    std::vector<double> stops = breakpoints(0, t);
    stops.push_back(t);
    for (const double to : stops) {
      for (int k = 0; k < num_dofs(); ++k) advance_mode(k, from, to, z[k], w[k]);
      from = to;
    }
    return {t, shapes_ * z, shapes_ * w};
  }

 private:
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return given_.stiffness; }
  Matrix damping(const Vector&) const override { return given_.beta * given_.stiffness; }

  double factor(double t) const {
    const auto& p = given_.factor;
    if (p.empty()) return 1;
    if (t <= p.front()[0]) return p.front()[1];
    for (std::size_t i = 1; i < p.size(); ++i)
      if (t <= p[i][0]) return p[i - 1][1] + (p[i][1] - p[i - 1][1]) * (t - p[i - 1][0]) / (p[i][0] - p[i - 1][0]);
    return p.back()[1];
  }

  // z'' + 2 d z' + w2 z = a + b (t - from): homogeneous exponentials and a linear particular part.
  void advance_mode(int k, double from, double to, double& z, double& rate) const {
    using C = std::complex<double>;
    const double w2 = omega_squared_[k], d = 0.5 * given_.beta * w2, tau = to - from;
    const double push = given_.load.size() ? shapes_.col(k).dot(given_.load) : 0;
    const double slope = (factor(to) - factor(from)) / tau * push, at_start = factor(from) * push;
    const double p1 = slope / w2, p0 = (at_start - 2 * d * p1) / w2;
    const C root = std::sqrt(C(d * d - w2)), l1 = -d + root, l2 = -d - root;
    const C y = z - p0, y_rate = rate - p1;
    const C c1 = (y_rate - l2 * y) / (l1 - l2), c2 = y - c1;
    z = p0 + p1 * tau + (c1 * std::exp(l1 * tau) + c2 * std::exp(l2 * tau)).real();
    rate = p1 + (c1 * l1 * std::exp(l1 * tau) + c2 * l2 * std::exp(l2 * tau)).real();
  }

  Given given_;
  Matrix shapes_;
  Vector omega_squared_;
};

inline Matrix scalar(double x) { return Matrix::Constant(1, 1, x); }

inline LinearModel harmonic_oscillator() {
  return LinearModel({.mass = scalar(2), .stiffness = scalar(18), .start = Vector::Ones(1), .end = 6, .velocity_scale = 3});
}

// A fifth of critical damping.
inline LinearModel damped_oscillator() {
  return LinearModel(
      {.mass = scalar(2), .stiffness = scalar(18), .beta = 0.4 / 3, .start = Vector::Ones(1), .end = 4, .velocity_scale = 3});
}

// Two equal oscillators joined by a spring 10^6 times stiffer: the joint motion is slow, the relative
// motion stiff and strongly damped.
inline LinearModel stiff_pair() {
  Matrix K(2, 2);
  K << 1 + 1e6, -1e6, -1e6, 1 + 1e6;
  return LinearModel({.mass = Matrix::Identity(2, 2), .stiffness = K, .beta = 0.1, .start = Vector::Ones(2), .end = 6});
}

// Pushed by a load that rises from t = 1 to t = 2 and then stays: two kinks.
inline LinearModel kinked_oscillator() {
  return LinearModel({.mass = scalar(1), .stiffness = scalar(9), .beta = 0.05, .load = Vector::Constant(1, 9),
                      .factor = {{1, 0}, {2, 1}}, .end = 4, .velocity_scale = 3});
}

// Two masses between springs, suddenly loaded (Bathe, Finite Element Procedures, 1996, example 9.1).
inline LinearModel bathes_two_masses() {
  const Matrix M = Vector{{2, 1}}.asDiagonal();
  const Matrix K{{6, -2}, {-2, 4}};
  return LinearModel({.mass = M, .stiffness = K, .load = Vector{{0, 10}}, .end = 3.36, .velocity_scale = 5});
}

// A slow motion beside a fast one with eigenvalues -10 +- 100i, on which multistep methods of high order stall
// (Enright, Hull & Lindberg 1975, problem B5; Shampine 1994). The fast one is small at the start.
inline LinearModel fast_ringing() {
  const Matrix K = Vector{{1, 10'100}}.asDiagonal();
  return LinearModel({.mass = Matrix::Identity(2, 2), .stiffness = K, .beta = 20.0 / 10'100, .start = Vector{{1, 0.01}},
                      .end = 3});
}

// Eight masses in a row between walls, damped; the first is drawn aside. With `consistent` the mass
// matrix of linear finite elements, else a diagonal one.
inline LinearModel chain(bool consistent) {
  const int n = 8;
  Matrix K = Matrix::Zero(n, n), M = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2;
    M(i, i) = consistent ? 4.0 / 6 : 1;
    if (i + 1 == n) continue;
    K(i, i + 1) = K(i + 1, i) = -1;
    if (consistent) M(i, i + 1) = M(i + 1, i) = 1.0 / 6;
  }
  return LinearModel({.mass = M, .stiffness = K, .beta = 0.1, .start = Vector::Unit(n, 0), .end = 8});
}

// A mass on a stiff spring in the plane, under gravity: q = (x, y) from the hinge.
class SpringPendulum : public SmallModel {
 public:
  SpringPendulum(const Vector& start, double drag) : SmallModel(Matrix::Identity(2, 2)), start_(start), drag_(drag) {
    traits_.damping_matrix = drag > 0;
    traits_.conservative = drag == 0;
  }

  static constexpr double kStiffness = 400, kGravity = 1;  // rest length 1, mass 1

  void force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    f = -kStiffness * (1 - 1 / q.norm()) * q - drag_ * v;
    f[1] -= kGravity;
  }
  // The spring's as in l^2, whose work is the change of its energy.
  void mean_force(double, const ConstVectorRef& q0, double, const ConstVectorRef& q1, const ConstVectorRef& v,
                  VectorRef f) const override {
    f = -0.5 * kStiffness * (1 - 2 / (q0.norm() + q1.norm())) * (q0 + q1) - drag_ * v;
    f[1] -= kGravity;
  }
  double energy(const State& s) const {
    return 0.5 * s.v.squaredNorm() + 0.5 * kStiffness * std::pow(s.q.norm() - 1, 2) + kGravity * s.q[1];
  }
  State initial() const override { return {0, start_, Vector::Zero(2)}; }
  double end() const override { return 5; }

 private:
  Matrix stiffness(double, const Vector& q, const Vector&, TangentKind kind) const override {
    const Vector n = q.normalized();
    const Matrix along = kStiffness * n * n.transpose();
    if (kind == TangentKind::gauss_newton) return along;
    return along + kStiffness * (1 - 1 / q.norm()) * (Matrix::Identity(2, 2) - n * n.transpose());
  }
  Matrix damping(const Vector&) const override { return drag_ * Matrix::Identity(2, 2); }

  Vector start_;
  double drag_;
};

// Released from the horizontal, the spring stretched a little.
inline SpringPendulum pendulum() { return {(Vector(2) << 1.001, 0).finished(), 0}; }

// A column that stands exactly upright, pressed a little: it stays, and its sideways stiffness is
// negative.
inline SpringPendulum upright_column() { return {(Vector(2) << 0, 0.99).finished(), 20}; }

// Follower force: a stiffness that is not symmetric. Stable, for it is damped.
class CirculatoryModel : public SmallModel {
 public:
  CirculatoryModel() : SmallModel(Matrix::Identity(2, 2), false) {
    traits_.damping_matrix = traits_.damped = true;
    traits_.conservative = false;
  }
  void force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    f = -stiffness_matrix() * q - v;
  }
  State initial() const override { return {0, Vector::Unit(2, 0), Vector::Zero(2)}; }
  double end() const override { return 3; }

  // The system is linear with constant coefficients: exp(A t) y(0).
  State exact(double t) const {
    Matrix A = Matrix::Zero(4, 4);
    A.topRightCorner(2, 2).setIdentity();
    A.bottomLeftCorner(2, 2) = -stiffness_matrix();
    A.bottomRightCorner(2, 2) = -Matrix::Identity(2, 2);
    const Eigen::EigenSolver<Matrix> modes(A);
    const Eigen::MatrixXcd V = modes.eigenvectors();
    const Eigen::VectorXcd growth = (modes.eigenvalues() * t).array().exp();
    const Vector y = (V * growth.asDiagonal() * V.inverse().col(0)).real();
    return {t, y.head(2), y.tail(2)};
  }

 private:
  static Matrix stiffness_matrix() { return (Matrix(2, 2) << 4, 1, -1, 9).finished(); }
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return stiffness_matrix(); }
  Matrix damping(const Vector&) const override { return Matrix::Identity(2, 2); }
};

// A model whose force does something else at chosen calls.
template <class Base>
class Disturbed : public Base {
 public:
  using Disturbance = std::function<void(long call, double t, VectorRef f)>;
  Disturbed(const Base& base, Disturbance disturb) : Base(base), disturb_(std::move(disturb)) {}
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    Base::force(t, q, v, f);
    disturb_(++calls_, t, f);
  }

 private:
  Disturbance disturb_;
  mutable long calls_ = 0;
};

}  // namespace orthodyn
