// Small models with constraints, and their motion by another method.
#pragma once

#include <vector>

#include "lib/ode/constraints.h"
#include "tests/contract/models.h"

namespace orthodyn {

// A model whose first coordinates, a point in space or in the plane, keep the distance 1 from a pivot on the x axis:
// with the place r of the point from the pivot, g = (r . r - 1) / 2, so that lambda is the tension.
class PivotedModel : public SmallModel, public Constraints {
 public:
  // `dimensions`: of the point. `shake`: amplitude of the pivot, m.
  PivotedModel(const Matrix& mass, int dimensions, double shake) : SmallModel(mass), d_(dimensions), shake_(shake) {}

  const Constraints* constraints() const override { return this; }
  int size() const override { return 1; }
  std::string name(int) const override { return "rod"; }
  void values(double t, const ConstVectorRef& q, VectorRef g) const override;
  Eigen::SparseMatrix<double> jacobian(double t, const ConstVectorRef& q) const override;
  void rates(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const override;
  void curvature(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef c) const override;

  static constexpr double kGravity = 10;

 protected:
  Vector pivot(double t) const { return shake_ * std::sin(kShaking * t) * Vector::Unit(d_, 0); }
  Vector pivot_rate(double t) const { return kShaking * shake_ * std::cos(kShaking * t) * Vector::Unit(d_, 0); }

 private:
  static constexpr double kShaking = 5;  // rad/s
  int d_;
  double shake_;
};

// A point of 2 kg on a rod, swinging in space: q = (x, y, z).
class SphericalPendulum : public PivotedModel {
 public:
  explicit SphericalPendulum(double shake = 0) : PivotedModel(2 * Matrix::Identity(3, 3), 3, shake) {
    traits_.linear = true;
    traits_.time_dependent = shake != 0;
  }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  State initial() const override;
  double end() const override { return 2; }
  Scales scales() const override { return {1, 3}; }
  double energy(const State& s) const { return s.v.squaredNorm() + 2 * kGravity * s.q[2]; }

 private:
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return Matrix::Zero(3, 3); }
};

// A point of 1 kg on a rod in the plane, and another one that hangs from it by a stiff, damped spring of 0.5 m: q =
// (x1, y1, x2, y2). The spring oscillates at 140 rad/s by default, the pendulum at 3 rad/s.
class StiffPendulum : public PivotedModel {
 public:
  // Of the spring, N/m and N s/m.
  explicit StiffPendulum(double stiffness = 1e4, double damping = 70)
      : PivotedModel(Matrix::Identity(4, 4), 2, 0), stiffness_(stiffness), damping_(damping) {
    traits_.damping_matrix = true;
  }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  State initial() const override;
  double end() const override { return 1; }
  Scales scales() const override { return {1, 3}; }

 private:
  static constexpr double kLength = 0.5;  // m
  double stiffness_, damping_;

  Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const override;
  Matrix damping(const Vector& q) const override;
};

// The state at ascending times (s), from the start of the model, with multipliers: by Runge and Kutta's method of order
// 4 on the equations of index 1, G a + c = 0, with steps (s) so short that its error is below 1e-9 in q, v and lambda.
std::vector<State> fine_motion(const PivotedModel& model, const std::vector<double>& times, double step);

}  // namespace orthodyn
