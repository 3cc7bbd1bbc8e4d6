// Small models whose solutions are known exactly.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

using Matrix = Eigen::MatrixXd;

// A model of a few unknowns with full matrices.
class SmallModel : public Model, public DiscreteGradient {
 public:
  int num_dofs() const override { return pattern_.n; }
  const Traits& traits() const override { return traits_; }
  const Pattern& pattern() const override { return pattern_; }

  void combine(const Weights& w, const Linearization& at, double* values) const override;
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override;
  void solve_mass(VectorRef x) const override;

  // Two halves of the force as named parts, as a body has them.
  std::vector<std::string> force_parts() const override { return {"gravity", "elasticity"}; }
  std::unique_ptr<Model> only(const std::vector<std::string>& parts) const override;

  const DiscreteGradient* discrete_gradient() const override { return this; }
  // Force at the midpoint: exact for a quadratic energy.
  void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1, const ConstVectorRef& v,
                  VectorRef f) const override;

  virtual State initial() const = 0;
  virtual double end() const = 0;
  virtual Scales scales() const { return {1, 1}; }

 protected:
  explicit SmallModel(const Matrix& mass, bool symmetric = true);

  virtual Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const = 0;
  virtual Matrix damping(const Vector& q) const;

  Matrix mass_;
  Traits traits_;

 private:
  friend class Share;

  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;

  void gather(const Matrix& full, double* values) const;

  Pattern pattern_;
};

// M q'' + (beta K) q' + K q = s(t) b with s piecewise linear: solved exactly, mode by mode.
class LinearModel : public SmallModel {
 public:
  struct Given {
    Matrix mass, stiffness;
    double beta = 0;                                 // s
    Vector load = {};                                // N; no load if empty
    std::vector<std::array<double, 2>> factor = {};  // times and values; constant beyond the ends
    Vector start = {};                               // q(0); v(0) = 0
    double end = 1;                                  // s
    double velocity_scale = 1;
  };

  explicit LinearModel(const Given& given);

  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  std::vector<double> breakpoints(double start, double end) const override;

  State initial() const override;
  double end() const override { return given_.end; }
  Scales scales() const override { return {1, given_.velocity_scale}; }

  State exact(double t) const;

 private:
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return given_.stiffness; }
  Matrix damping(const Vector&) const override;
  double factor(double t) const;
  void advance_mode(int k, double from, double to, double& z, double& rate) const;

  Given given_;
  Matrix shapes_;
  Vector omega_squared_;
};

inline Matrix scalar(double x) { return Matrix::Constant(1, 1, x); }

LinearModel harmonic_oscillator();

// Damping ratio 1/5.
LinearModel damped_oscillator();

// Two equal oscillators joined by a spring 10^6 times stiffer: the joint motion is slow, the relative
// motion stiff and strongly damped.
LinearModel stiff_pair();

// Loaded by a ramp from t = 1 to t = 2, then constant: two kinks.
LinearModel kinked_oscillator();

// Two masses between springs, suddenly loaded (Bathe, Finite Element Procedures, 1996, example 9.1).
LinearModel bathes_two_masses();

// A slow and a fast motion with eigenvalues -10 +- 100i, on which multistep methods of high order stall (Enright, Hull
// & Lindberg 1975, problem B5; Shampine 1994). The fast motion is small at the start.
LinearModel fast_ringing();

// Eight damped masses in a row between walls; the first is displaced. `consistent`: the mass matrix of linear finite
// elements, otherwise a diagonal one.
LinearModel chain(bool consistent);

// A mass on a stiff spring in the plane, under gravity: q = (x, y) from the hinge.
class SpringPendulum : public SmallModel {
 public:
  SpringPendulum(const Vector& start, double drag);

  static constexpr double kStiffness = 400, kGravity = 1;  // rest length 1, mass 1

  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  // Discrete gradient of the spring in l^2, whose work is the change of its energy.
  void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1, const ConstVectorRef& v,
                  VectorRef f) const override;
  double energy(const State& s) const;
  State initial() const override;
  double end() const override { return 5; }

 private:
  Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const override;
  Matrix damping(const Vector& q) const override;

  Vector start_;
  double drag_;
};

// Released from the horizontal with a slightly stretched spring.
SpringPendulum pendulum();

// An exactly upright column under slight compression: it stays upright, and its transverse stiffness is negative.
SpringPendulum upright_column();

// A follower force: unsymmetric stiffness. Stable because of its damping.
class CirculatoryModel : public SmallModel {
 public:
  CirculatoryModel();
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  State initial() const override;
  double end() const override { return 3; }

  // The system is linear with constant coefficients: exp(A t) y(0).
  State exact(double t) const;

 private:
  Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const override;
  Matrix damping(const Vector& q) const override;
};

// A model whose force behaves differently in selected calls.
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
