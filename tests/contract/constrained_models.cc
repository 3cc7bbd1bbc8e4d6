#include "tests/contract/constrained_models.h"

#include <cmath>

#include "lib/ode/constraints_at.h"

namespace orthodyn {

void PivotedModel::values(double t, const ConstVectorRef& q, VectorRef g) const {
  g[0] = ((q.head(d_) - pivot(t)).squaredNorm() - 1) / 2;
}

Eigen::SparseMatrix<double> PivotedModel::jacobian(double t, const ConstVectorRef& q) const {
  const Vector r = q.head(d_) - pivot(t);
  Eigen::SparseMatrix<double> G(q.size(), 1);
  for (int i = 0; i < d_; ++i) G.insert(i, 0) = r[i];
  return G;
}

void PivotedModel::rates(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const {
  g_rate[0] = (q.head(d_) - pivot(t)).dot(v.head(d_) - pivot_rate(t));
}

void PivotedModel::curvature(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef c) const {
  const Vector pivot_acceleration = -kShaking * kShaking * pivot(t);
  c[0] = (v.head(d_) - pivot_rate(t)).squaredNorm() - (q.head(d_) - pivot(t)).dot(pivot_acceleration);
}

void SphericalPendulum::force(double, const ConstVectorRef&, const ConstVectorRef&, VectorRef f) const {
  f = Vector{{0, 0, -2 * kGravity}};
}

State SphericalPendulum::initial() const {
  const double angle = 1;
  return {0, pivot(0) + Vector{{std::sin(angle), 0, -std::cos(angle)}}, pivot_rate(0) + Vector{{0, 1.5, 0}}};
}

void StiffPendulum::force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  const Eigen::Vector2d r = q.tail<2>() - q.head<2>(), rate = v.tail<2>() - v.head<2>(), n = r.normalized();
  const Eigen::Vector2d pull = (stiffness_ * (r.norm() - kLength) + damping_ * n.dot(rate)) * n;
  f << pull, -pull;
  f[1] -= kGravity;
  f[3] -= kGravity;
}

State StiffPendulum::initial() const {
  const double angle = 1, x = std::sin(angle), y = -std::cos(angle);
  return {0, Vector{{x, y, x, y - kLength}}, Vector::Zero(4)};
}

namespace {

// B acts on the difference of the two points.
Matrix on_difference(const Eigen::Matrix2d& B) {
  Matrix out(4, 4);
  out << B, -B, -B, B;
  return out;
}

}  // namespace

Matrix StiffPendulum::stiffness(double, const Vector& q, const Vector&, TangentKind) const {
  const Eigen::Vector2d r = q.tail<2>() - q.head<2>(), n = r.normalized();
  const double slack = kLength / r.norm();
  return stiffness_ * on_difference((1 - slack) * Eigen::Matrix2d::Identity() + slack * n * n.transpose());
}

Matrix StiffPendulum::damping(const Vector& q) const {
  const Eigen::Vector2d n = (q.tail<2>() - q.head<2>()).normalized();
  return damping_ * on_difference(n * n.transpose());
}

std::vector<State> fine_motion(const PivotedModel& model, const std::vector<double>& times, double step) {
  const auto accelerated = [&](State s) {
    Vector a(s.q.size());
    model.force(s.t, s.q, s.v, a);
    model.solve_mass(a);
    s.lambda = ConstraintsAt(model, s.t, s.q).multipliers(s.v, a);
    return std::pair(s, a);
  };
  std::vector<State> out;
  State now = model.initial();
  for (const double end : times) {
    const auto count = static_cast<int>(std::ceil((end - now.t) / step));
    const double h = count > 0 ? (end - now.t) / count : 0;
    for (int k = 0; k < count; ++k) {
      const auto stage = [&](double share, const Vector& v, const Vector& a) {
        return accelerated({now.t + share * h, now.q + share * h * v, now.v + share * h * a});
      };
      const auto [s1, a1] = accelerated(now);
      const auto [s2, a2] = stage(0.5, s1.v, a1);
      const auto [s3, a3] = stage(0.5, s2.v, a2);
      const auto [s4, a4] = stage(1, s3.v, a3);
      now.q += h / 6 * (s1.v + 2 * s2.v + 2 * s3.v + s4.v);
      now.v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      now.t += h;
    }
    now.t = end;
    out.push_back(accelerated(now).first);
  }
  return out;
}

}  // namespace orthodyn
