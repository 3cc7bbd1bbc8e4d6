#include "lib/simulation/error_estimate/modal_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

constexpr int kLargest = 2000;
constexpr double kCoupling = 1e-9;  // coupling over the largest modal damping
constexpr double kRigid = 1e-12;    // eigenvalue over the largest one: below it, a rigid mode
constexpr double kHidden = 1e-8;    // eigenvalue over the largest one: below it, too close to round-off

// Dense matrix of a model with a symmetric pattern.
Eigen::MatrixXd dense(const Model& model, const Linearization& at, const Weights& weights) {
  const Pattern& pattern = model.pattern();
  std::vector<double> values(pattern.row.size());
  model.combine(weights, at, values.data());
  const Eigen::MatrixXd stored(pattern.matrix(values.data()));
  return stored.selfadjointView<Eigen::Lower>();
}

struct Coordinate {
  double q, v;
};

// Solution of q'' + d q' + lambda q = f after a time t.
Coordinate oscillate(double lambda, double d, double f, Coordinate start, double t) {
  const double s = d / 2, rest = f / lambda, a = start.q - rest;
  const double discriminant = lambda - s * s;
  if (discriminant > 0) {
    const double w = std::sqrt(discriminant), b = (start.v + s * a) / w;
    const double decay = std::exp(-s * t), c = std::cos(w * t), n = std::sin(w * t);
    return {rest + decay * (a * c + b * n), decay * ((w * b - s * a) * c - (w * a + s * b) * n)};
  }
  // Overdamped; written so that equal roots cause no division by zero.
  const double r = std::sqrt(-discriminant), b = start.v + s * a;
  const double sinh_over_r = r * t < 1e-9 ? t * std::exp(-s * t)
                             : r * t < 1  ? std::exp(-s * t) * std::sinh(r * t) / r
                                          : (std::exp((r - s) * t) - std::exp((-r - s) * t)) / (2 * r);
  const double cosh = (std::exp((r - s) * t) + std::exp((-r - s) * t)) / 2;
  return {rest + a * cosh + b * sinh_over_r, b * cosh - s * a * cosh + (r * r * a - s * b) * sinh_over_r};
}

// phi_1 = (1 - exp(-x)) / x and phi_2 = (1 - phi_1) / x, without cancellation.
double phi_1(double x) { return x == 0 ? 1 : -std::expm1(-x) / x; }
double phi_2(double x) {
  if (std::abs(x) > 0.01) return (1 - phi_1(x)) / x;
  return 1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x / 720)));
}

// Solution of q'' + d q' = f after a time t.
Coordinate drift_away(double d, double f, Coordinate start, double t) {
  const double x = d * t;
  return {start.q + start.v * t * phi_1(x) + f * t * t * phi_2(x), start.v * std::exp(-x) + f * t * phi_1(x)};
}

}  // namespace

std::optional<ModalSolution> ModalSolution::find(const Model& model, const State& initial) {
  const auto& traits = model.traits();
  if (!traits.linear || model.internal_variables() || traits.time_dependent || !model.pattern().symmetric ||
      model.num_dofs() > kLargest)
    return std::nullopt;
  const Vector zero = Vector::Zero(model.num_dofs());
  Linearization at;
  model.linearize(initial.t, zero, zero, TangentKind::exact, at);
  const Eigen::MatrixXd M = dense(model, at, {1, 0, 0});
  const auto modes = symmetric_eigenpairs(dense(model, at, {0, 0, 1}), M);
  if (!modes.values.allFinite()) return std::nullopt;
  ModalSolution solution;
  solution.start_ = initial.t;
  solution.shapes_ = modes.vectors;
  const auto& phi = solution.shapes_;
  const Eigen::MatrixXd D = phi.transpose() * dense(model, at, {0, 1, 0}) * phi;
  solution.damping_ = D.diagonal();
  const double coupling = (D - Eigen::MatrixXd(solution.damping_.asDiagonal())).cwiseAbs().maxCoeff();
  const double largest_damping = solution.damping_.cwiseAbs().maxCoeff();
  if (coupling > kCoupling * largest_damping) return std::nullopt;
  solution.lambda_ = modes.values;
  const double largest = solution.lambda_.maxCoeff();
  for (Eigen::Index i = 0; i < solution.lambda_.size(); ++i) {
    double& lambda = solution.lambda_[i];
    if (lambda > kHidden * largest) continue;
    if (lambda > kRigid * largest) return std::nullopt;
    lambda = 0;
    if (solution.damping_[i] < kRigid * largest_damping) solution.damping_[i] = 0;
  }
  Vector load(zero.size());
  model.force(initial.t, zero, zero, load);
  solution.load_ = phi.transpose() * load;
  solution.q_ = phi.transpose() * (M * initial.q);
  solution.v_ = phi.transpose() * (M * initial.v);
  return solution;
}

double ModalSolution::round_off(double t) const {
  const double largest = lambda_.maxCoeff();
  double slowest = largest;
  for (const double lambda : lambda_)
    if (lambda > 0) slowest = std::min(slowest, lambda);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  return eps * (1 + largest / slowest * std::sqrt(slowest) * (t - start_) / 2);
}

State ModalSolution::at(double t) const {
  Vector q(q_.size()), v(q_.size());
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    const Coordinate start{q_[i], v_[i]};
    const Coordinate now = lambda_[i] > 0 ? oscillate(lambda_[i], damping_[i], load_[i], start, t - start_)
                                          : drift_away(damping_[i], load_[i], start, t - start_);
    q[i] = now.q;
    v[i] = now.v;
  }
  return {t, shapes_ * q, shapes_ * v};
}

}  // namespace orthodyn
