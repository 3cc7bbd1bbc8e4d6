#include "integrators/native/modal_basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "lib/core/errors.h"
#include "lib/linear/eigenmodes.h"

namespace orthodyn {
namespace {

constexpr double kShift = 1e-6;       // shift s, relative to the first eigenvalue left out
constexpr double kCoupling = 1e-5;    // largest accepted coupling of modes by damping, relative to an amplitude
constexpr int kFirstCount = 20;       // number of modes of the first search for `below`
constexpr double kRayleigh = 1e-6;    // accepted misfit of alpha M + beta K, relative to the largest entry
constexpr double kNoDamping = 1e-13;  // relative to the largest entry; smaller parts are treated as zero

double hertz(double lambda) { return std::sqrt(lambda) / (2 * std::numbers::pi); }

void require_linear(const Model& model) {
  if (!model.traits().linear)
    throw ConfigError(
        "modal integrates only linear models, and this model is nonlinear: set `elasticity.kinematics: linear` and use "
        "no contact, following pressure or turning springs and dashpots, or use another integrator");
  if (!model.pattern().symmetric) throw ConfigError("modal needs a symmetric stiffness; use another integrator");
}

Vector root_of_diagonal(const Pattern& pattern, const std::vector<double>& M) {
  Vector root(pattern.n);  // the first entry of each column is the diagonal
  for (int j = 0; j < pattern.n; ++j)
    root[j] = std::sqrt(M[static_cast<std::size_t>(pattern.column_start[static_cast<std::size_t>(j)])]);
  return root;
}

// Best fit of D = alpha M + beta K.
struct Rayleigh {
  double alpha = 0, beta = 0;
  double misfit = 0;  // largest entry of the residual, relative to that of D
};

Rayleigh rayleigh_fit(const Pattern& pattern, const std::vector<double>& M, const std::vector<double>& K,
                      const std::vector<double>& D) {
  const Vector unit = root_of_diagonal(pattern, M);
  const auto n = static_cast<Eigen::Index>(M.size());
  Eigen::MatrixXd A(n, 2);
  Vector b(n);
  Eigen::Index row = 0;
  for (int j = 0; j < pattern.n; ++j)
    for (int at = pattern.column_start[static_cast<std::size_t>(j)];
         at < pattern.column_start[static_cast<std::size_t>(j) + 1]; ++at, ++row) {
      const auto k = static_cast<std::size_t>(at);
      const double u = unit[pattern.row[k]] * unit[j];
      A.row(row) << M[k] / u, K[k] / u;
      b[row] = D[k] / u;
    }
  const Eigen::RowVector2d sizes = A.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled = A * sizes.cwiseInverse().asDiagonal();
  const Eigen::Vector2d fit = scaled.colPivHouseholderQr().solve(b);
  Rayleigh out{fit[0] / sizes[0], fit[1] / sizes[1]};
  const double largest = b.lpNorm<Eigen::Infinity>();
  out.misfit = largest > 0 ? (scaled * fit - b).lpNorm<Eigen::Infinity>() / largest : 0;
  // A part within round-off is set to zero.
  for (const auto& [part, column] : {std::pair{&out.alpha, 0}, std::pair{&out.beta, 1}})
    if (std::abs(*part) * A.col(column).lpNorm<Eigen::Infinity>() <= kNoDamping * largest) *part = 0;
  return out;
}

Vector product(const Pattern& pattern, const std::vector<double>& values, const Vector& x) {
  Vector y = Vector::Zero(x.size());
  if (!values.empty()) pattern.multiply(values.data(), x, y);
  return y;
}

}  // namespace

ModalBasis::ModalBasis(const Model& model, const ModeLimit& limit) : model_(model) {
  require_linear(model);
  const Vector zero = Vector::Zero(model.num_dofs());
  model.linearize(0, zero, zero, TangentKind::exact, at_);
  const auto entries = model.pattern().row.size();
  stiffness_.resize(entries);
  mass_.resize(entries);
  model.combine({0, 0, 1}, at_, stiffness_.data());
  model.combine({1, 0, 0}, at_, mass_.data());
  damping_entries_.resize(entries);
  model.combine({0, 1, 0}, at_, damping_entries_.data());
  if (std::all_of(damping_entries_.begin(), damping_entries_.end(), [](double d) { return d == 0; }))
    damping_entries_.clear();
  find_modes(limit);
  set_modal_damping();
  if (!complete_) factor();
}

void ModalBasis::find_modes(const ModeLimit& limit) {
  if (limit.modes) find_lowest(*limit.modes);
  else find_below(*limit.below);
  if (lambda_.minCoeff() < 0)
    throw ConfigError(
        "the state of rest is not stable: modal needs a stiffness without negative eigenvalues; use another "
        "integrator");
  if (!complete_ && next_lambda_ == 0)
    throw ConfigError(fmt::format(
        "{} modes do not include all motions without stiffness (a free body has 6); keep more modes", lambda_.size()));
}

// Finds `count` modes, and the eigenvalue of the first mode left out.
void ModalBasis::find_lowest(int count) {
  const int n = model_.num_dofs();
  complete_ = count >= n;
  const int kept = std::min(count, n);
  EigenPairs pairs = lowest_eigenpairs(model_.pattern(), stiffness_, mass_, complete_ ? n : kept + 1,
                                       [this, n] { return model_.rigid_motions(Vector::Zero(n)); });
  lambda_ = pairs.values.head(kept);
  shapes_ = pairs.shapes.leftCols(kept);
  next_lambda_ = complete_ ? 0 : pairs.values[kept];
  resolution_ = pairs.resolution;
}

void ModalBasis::find_below(double frequency) {
  const double limit = std::pow(2 * std::numbers::pi * frequency, 2);
  for (int count = kFirstCount;; count = std::min(more_modes(count, next_lambda_, limit), kMostModesBelow)) {
    find_lowest(count);
    if (complete_ || next_lambda_ >= limit) break;
    if (count >= kMostModesBelow)
      throw ConfigError(
          fmt::format("more than {} modes lie below {:.6g} Hz, the last of them at {:.6g} Hz; lower `below`, or use "
                      "another integrator",
                      count, frequency, hertz(lambda_[lambda_.size() - 1])));
  }
  const auto kept =
      static_cast<Eigen::Index>(std::lower_bound(lambda_.begin(), lambda_.end(), limit) - lambda_.begin());
  if (kept == 0)
    throw ConfigError(fmt::format("no mode lies below {:.6g} Hz, the first is at {:.6g} Hz; raise `below`", frequency,
                                  hertz(lambda_[0])));
  if (kept == lambda_.size()) return;
  next_lambda_ = lambda_[kept];
  complete_ = false;
  lambda_.conservativeResize(kept);
  shapes_.conservativeResize(Eigen::NoChange, kept);
}

// Rayleigh damping is treated separately, so that stiffness damping has exactly no effect on rigid motions.
void ModalBasis::set_modal_damping() {
  damping_ = Vector::Zero(size());
  if (damping_entries_.empty()) return;
  const Pattern& pattern = model_.pattern();
  const Rayleigh fit = rayleigh_fit(pattern, mass_, stiffness_, damping_entries_);
  if (fit.misfit <= kRayleigh) {
    damping_ = (fit.alpha + fit.beta * lambda_.array()).max(0).matrix();
    next_damping_ = fit.alpha + fit.beta * next_lambda_;
    return;
  }
  set_general_damping();
}

// Other damping is accepted if the coupling of the modes is negligible. A coupling c (1/s) excites another mode to a
// relative amplitude of c/|omega_1 - omega_2|, or c/d for equal frequencies and modal damping d.
void ModalBasis::set_general_damping() {
  Eigen::MatrixXd damping_forces(shapes_.rows(), size());
  for (Eigen::Index k = 0; k < size(); ++k) damping_forces.col(k) = times_damping(shapes_.col(k));
  const Eigen::MatrixXd modal_damping = shapes_.transpose() * damping_forces;
  damping_ = modal_damping.diagonal().cwiseMax(0);
  next_damping_ = 0;  // unknown
  const Vector omega = lambda_.cwiseSqrt();
  double worst = 0;
  const auto record = [&](double coupling, double gap, double d) {
    if (coupling > 0) worst = std::max(worst, coupling / std::max(std::abs(gap), d));
  };
  for (Eigen::Index k = 0; k < size(); ++k) {
    for (Eigen::Index j = 0; j < k; ++j)
      record(std::abs(modal_damping(j, k)), omega[k] - omega[j], 0.5 * (damping_[j] + damping_[k]));
    if (complete_) continue;
    // Component in the modes left out.
    const Vector out = damping_forces.col(k) - times_mass(shapes_ * modal_damping.col(k));
    Vector accelerated = out;
    model_.solve_mass(accelerated);
    record(std::sqrt(std::max(out.dot(accelerated), 0.0)), std::sqrt(next_lambda_) - omega[k], damping_[k]);
  }
  if (!(worst <= kCoupling)) refuse_coupled_damping(worst);
}

void ModalBasis::refuse_coupled_damping(double share) const {
  const auto parts = model_.force_parts();
  const auto has = [&](const char* name) {
    return std::any_of(parts.begin(), parts.end(), [&](const std::string& part) { return part.starts_with(name); });
  };
  const auto [what, remedy] =
      has("dashpots")  ? std::pair{"dashpots", "Remove the dashpots"}
      : has("springs") ? std::pair{"stiffness damping, which the springs do not have,",
                                   "Take damping.mass in place of damping.stiffness, or softer springs"}
                       : std::pair{"damping that differs among regions", "Give all regions the same stiffness damping"};
  throw ConfigError(
      fmt::format("modal needs damping that does not couple the modes, alpha M + beta K; here {} couples them (to "
                  "{:.2g} of an amplitude, {:.0e} is allowed). {}, or use another integrator",
                  what, share, kCoupling, remedy));
}

void ModalBasis::factor() {
  const Pattern& pattern = model_.pattern();
  solver_ = make_solver_for(pattern);
  std::vector<double> values = stiffness_;
  shifted_ = lambda_[0] == 0 || solver_->factor(values.data()) != FactorStatus::ok;
  if (!shifted_) return;
  double shift = std::max(kShift * next_lambda_, resolution_);
  for (; shift < next_lambda_; shift *= 100) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = stiffness_[k] + shift * mass_[k];
    if (solver_->factor(values.data()) == FactorStatus::ok) return;
  }
  throw RunError(
      "the stiffness is not positive definite, and no small shift makes it so: modal has no static response of the "
      "modes left out; use another integrator");
}

Vector ModalBasis::coordinates(const Vector& q) const { return shapes_.transpose() * times_mass(q); }

Vector ModalBasis::static_correction(const Vector& f, const Vector& modal) const {
  if (complete_) return Vector::Zero(f.size());
  const Vector left_out = f - times_mass(shapes_ * modal);
  Vector u(f.size());
  solver_->solve(left_out, u);
  if (shifted_) u -= shapes_ * coordinates(u);
  return u;
}

Vector ModalBasis::times_mass(const Vector& x) const { return product(model_.pattern(), mass_, x); }
Vector ModalBasis::times_damping(const Vector& x) const { return product(model_.pattern(), damping_entries_, x); }
Vector ModalBasis::times_stiffness(const Vector& x) const { return product(model_.pattern(), stiffness_, x); }

std::size_t ModalBasis::bytes() const {
  return sizeof(double) * (stiffness_.size() + mass_.size() + damping_entries_.size() + at_.stiffness.size() +
                           at_.damping.size() + static_cast<std::size_t>(shapes_.size()));
}

}  // namespace orthodyn
