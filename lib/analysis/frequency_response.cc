#include "lib/analysis/frequency_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <utility>

#include "lib/core/errors.h"
#include "lib/ode/internal_variables.h"

namespace orthodyn {

namespace {

using Values = std::vector<double>;  // of a matrix on the model's pattern

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kDependent = 1e-8;  // M-norm of the part outside of the basis, relative to the whole direction
constexpr int kMostAdded = 200;      // vectors besides the modes
constexpr double kShift = 1e-6;      // shift s, relative to the lowest nonzero eigenvalue
constexpr double kSmallPart = 1e-6;  // real or imaginary part that is left out, relative to the other

using Complex = std::complex<double>;

Values values_of(const Model& model, const Weights& weights, const Linearization& at) {
  Values out(model.pattern().row.size());
  model.combine(weights, at, out.data());
  return out;
}

}  // namespace

FrequencyResponse::FrequencyResponse(const Model& model, const State& about, const Modes& modes,
                                     const ComplexVector& load, VibrationDamping damping, const VibrationRange& range)
    : model_(model), loss_(std::move(damping.loss)), ratio_(damping.ratio), load_(load) {
  if (!modes.modes.empty() && modes.modes.front().lambda < 0)
    throw ConfigError("analysis",
                      "harmonic: the body is unstable about its steady state (a natural frequency is "
                      "imaginary), so that it does not vibrate steadily; reduce the steady loads");
  Linearization at;
  model.linearize(about.t, about.q, Vector::Zero(about.q.size()), TangentKind::exact, at);
  stiffness_ = values_of(model, {0, 0, 1}, at);
  mass_ = values_of(model, {1, 0, 0}, at);
  viscous_ = values_of(model, {0, 1, 0}, at);
  if (std::all_of(viscous_.begin(), viscous_.end(), [](double d) { return d == 0; })) viscous_.clear();
  if (model.internal_variables()) find_branches(about);
  lambda_.resize(std::ssize(modes.modes));
  zeros_ = modes.zeros;
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    lambda_[static_cast<Eigen::Index>(k)] = modes.modes[k].lambda;
    if (!add(modes.modes[k].shape))
      throw RunError("two of the natural modes are the same: raise the highest frequency");
  }
  set_loss_factors();
  if (lambda_.size() < model_.num_dofs()) extend_basis(range);  // otherwise the modes are a complete basis
  find_coupled(range.rtol);
}

// The stiffness without relaxation minus that with the relaxation of one time only.
void FrequencyResponse::find_branches(const State& about) {
  const InternalVariables& internal = *model_.internal_variables();
  const auto stiffness = [&](InternalState::Kind kind, double time) {
    Linearization at;
    internal.assemble(about.t, about.q, Vector::Zero(about.q.size()), {kind, nullptr, time}, TangentKind::gauss_newton,
                      at);
    return values_of(model_, {0, 0, 1}, at);
  };
  const Values at_once = stiffness(InternalState::Kind::given, 0);
  const Vector& times = internal.relaxation_times();
  for (const double time : std::set<double>(times.begin(), times.end())) {
    Branch branch{time, stiffness(InternalState::Kind::branch, time), {}};
    for (std::size_t k = 0; k < at_once.size(); ++k) branch.stiffness[k] = at_once[k] - branch.stiffness[k];
    branches_.push_back(std::move(branch));
  }
}

std::complex<double> FrequencyResponse::relaxing(double omega, Eigen::Index j, Eigen::Index k) const {
  Complex sum = 0;
  for (const Branch& branch : branches_) sum += branch.factor(omega) * branch.reduced(j, k);
  return sum;
}

// The stiffness rises with the frequency, which rises with the stiffness: to round-off after few passes.
double FrequencyResponse::frequency_of_mode(Eigen::Index k) const {
  constexpr int kPasses = 100;
  double omega = std::sqrt(std::max(lambda_[k], 0.0));
  if (k < zeros_ || branches_.empty()) return omega;
  for (int pass = 0; pass < kPasses; ++pass) omega = std::sqrt(lambda_[k] + relaxing(omega, k, k).real());
  return omega;
}

double FrequencyResponse::frequency(int mode) const { return omega_[mode] / kTwoPi; }

Vector FrequencyResponse::product(const Values& values, const Vector& x) const {
  Vector y = Vector::Zero(x.size());
  if (!values.empty()) model_.multiply_matrix(values.data(), x, y);
  return y;
}

ComplexVector FrequencyResponse::product(const Values& values, const ComplexVector& x) const {
  ComplexVector y(x.size());
  y.real() = product(values, Vector(x.real()));
  y.imag() = product(values, Vector(x.imag()));
  return y;
}

void FrequencyResponse::set_loss_factors() {
  loss_factors_ = Vector::Zero(lambda_.size());
  const auto damping = [&](Eigen::Index j, Eigen::Index k) {
    const double omega = std::sqrt(omega_[j] * omega_[k]);
    return reduced_loss_(j, k) + omega * reduced_viscous_(j, k) + relaxing(omega, j, k).imag();
  };
  const auto squared = [&](Eigen::Index k) { return branches_.empty() ? lambda_[k] : omega_[k] * omega_[k]; };
  constexpr double kClose = 10;  // distance of eigenvalues, relative to their damping, up to which modes mix
  for (Eigen::Index begin = zeros_, end; begin < lambda_.size(); begin = end) {
    for (end = begin + 1; end < lambda_.size(); ++end)
      if (std::abs(squared(end) - squared(end - 1)) > kClose * (damping(end, end) + damping(end - 1, end - 1))) break;
    const Eigen::Index size = end - begin;
    Eigen::MatrixXcd close(size, size);
    for (Eigen::Index j = 0; j < size; ++j)
      for (Eigen::Index k = 0; k < size; ++k)
        close(j, k) = Complex(j == k ? squared(begin + j) : 0, damping(begin + j, begin + k));
    ComplexVector eigenvalues = close.diagonal();
    if (size > 1) eigenvalues = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(close, false).eigenvalues();
    std::sort(eigenvalues.begin(), eigenvalues.end(), [](Complex a, Complex b) { return a.real() < b.real(); });
    for (Eigen::Index k = 0; k < size; ++k) loss_factors_[begin + k] = eigenvalues[k].imag() / eigenvalues[k].real();
  }
}

// K + s M with s = 0 if K is positive definite. For a free body s is small, so that elastic responses do not change.
void FrequencyResponse::factor() {
  solver_ = make_solver_for(model_.pattern());
  if (zeros_ == 0 && solver_->factor(stiffness_.data()) == FactorStatus::ok) return;
  const double lowest = zeros_ < lambda_.size() ? lambda_[zeros_] : 0;
  Values shifted(stiffness_.size());
  for (double shift = kShift * lowest; lowest > 0 && shift <= lowest; shift *= 100) {
    for (std::size_t k = 0; k < shifted.size(); ++k) shifted[k] = stiffness_[k] + shift * mass_[k];
    solver_ = make_solver_for(model_.pattern());
    if (solver_->factor(shifted.data()) == FactorStatus::ok) return;
  }
  throw RunError(
      "the stiffness is singular beyond the rigid motions of the body: clamp the body, or use a coarser mesh");
}

// Makes the direction M-orthonormal to the basis, and adds it. False if it lies in the basis.
bool FrequencyResponse::add(Vector direction) {
  const Eigen::Index size = basis_.cols(), modes = lambda_.size();
  double norm = std::sqrt(direction.dot(product(mass_, direction)));
  if (!(norm > 0)) return false;
  direction /= norm;
  for (int pass = 0; pass < 2 && size > 0; ++pass) direction -= basis_ * (mass_times_basis_.transpose() * direction);
  Vector times_mass = product(mass_, direction);
  norm = std::sqrt(direction.dot(times_mass));
  if (!(norm > kDependent)) return false;
  basis_.conservativeResize(direction.size(), size + 1);
  mass_times_basis_.conservativeResize(direction.size(), size + 1);
  basis_.col(size) = direction / norm;
  mass_times_basis_.col(size) = times_mass / norm;
  const auto extend = [&](Eigen::MatrixXd& reduced, const Vector& column) {
    reduced.conservativeResize(size + 1, size + 1);
    reduced.col(size) = column;
    reduced.row(size) = column.transpose();
  };
  // The eigenvalues of the modes are more accurate than products with K, to which other vectors are orthogonal.
  Vector stiffness = Vector::Zero(size + 1);
  if (size < modes) stiffness[size] = lambda_[size];
  else
    stiffness.tail(size + 1 - modes) =
        basis_.rightCols(size + 1 - modes).transpose() * product(stiffness_, Vector(basis_.col(size)));
  extend(reduced_stiffness_, stiffness);
  Vector loss = basis_.transpose() * product(loss_, Vector(basis_.col(size)));
  loss.head(std::min(zeros_, size + 1)).setZero();  // rigid motions cause no strain
  if (size < zeros_) loss.setZero();
  extend(reduced_loss_, loss);
  extend(reduced_viscous_, basis_.transpose() * product(viscous_, Vector(basis_.col(size))));
  for (Branch& branch : branches_) {
    Vector column = basis_.transpose() * product(branch.stiffness, Vector(basis_.col(size)));
    column.head(std::min(zeros_, size + 1)).setZero();
    if (size < zeros_) column.setZero();
    extend(branch.reduced, column);
  }
  if (size < modes) {
    omega_.conservativeResize(size + 1);
    omega_[size] = frequency_of_mode(size);
    reduced_viscous_(size, size) += 2 * ratio_ * omega_[size];
  }
  reduced_load_.conservativeResize(size + 1);
  reduced_load_[size] = Complex(basis_.col(size).dot(load_.real()), basis_.col(size).dot(load_.imag()));
  return true;
}

bool FrequencyResponse::add_parts(const ComplexVector& x) {
  const Vector real = x.real(), imaginary = x.imag();
  const double least = kSmallPart * x.norm();
  const bool has_real = real.norm() > least && add(real);
  return (imaginary.norm() > least && add(imaginary)) || has_real;
}

ComplexVector FrequencyResponse::reduced(const ComplexVector& load) const {
  ComplexVector out(basis_.cols());
  out.real() = basis_.transpose() * load.real();
  out.imag() = basis_.transpose() * load.imag();
  return out;
}

void FrequencyResponse::include(const ComplexVector& load, const VibrationRange& range) {
  if (lambda_.size() == model_.num_dofs() || load.isZero(0)) return;
  const ComplexVector own = std::exchange(load_, load);
  reduced_load_ = reduced(load_);
  end_ = End::converged;
  extend_basis(range);
  find_coupled(range.rtol);
  load_ = own;
  reduced_load_ = reduced(load_);
}

ComplexVector FrequencyResponse::coordinates(double frequency, const ComplexVector& reduced_load) const {
  const double omega = kTwoPi * frequency;
  const auto entry = [&](Eigen::Index j, Eigen::Index k) {
    const Complex own(reduced_stiffness_(j, k) - (j == k ? omega * omega : 0),
                      reduced_loss_(j, k) + omega * reduced_viscous_(j, k));
    return own + relaxing(omega, j, k);
  };
  ComplexVector y(basis_.cols());
  if (alone_.empty() && coupled_.empty()) {  // before find_coupled()
    Eigen::MatrixXcd A(basis_.cols(), basis_.cols());
    A.real() = reduced_stiffness_;
    A.imag() = reduced_loss_ + omega * reduced_viscous_;
    for (const Branch& branch : branches_) A += branch.factor(omega) * branch.reduced;
    A.diagonal().array() -= omega * omega;
    return A.partialPivLu().solve(reduced_load);
  }
  for (const Eigen::Index k : alone_) y[k] = reduced_load[k] / entry(k, k);
  const auto size = std::ssize(coupled_);
  if (size == 0) return y;
  Eigen::MatrixXcd A(size, size);
  for (Eigen::Index k = 0; k < size; ++k)
    for (Eigen::Index j = 0; j < size; ++j)
      A(j, k) = entry(coupled_[static_cast<std::size_t>(j)], coupled_[static_cast<std::size_t>(k)]);
  ComplexVector load(size);
  for (Eigen::Index k = 0; k < size; ++k) load[k] = reduced_load[coupled_[static_cast<std::size_t>(k)]];
  const ComplexVector part = A.partialPivLu().solve(load);
  for (Eigen::Index k = 0; k < size; ++k) y[coupled_[static_cast<std::size_t>(k)]] = part[k];
  return y;
}

// Separates the modes that damping does not couple with other vectors, so that coordinates() solves a small system. A
// coupling is negligible if it changes amplitudes by less than a hundredth of the tolerance.
void FrequencyResponse::find_coupled(double tolerance) {
  const auto is_small = [&](const Eigen::MatrixXd& A, Eigen::Index j, Eigen::Index k) {
    return std::abs(A(j, k)) <= 0.01 * tolerance / static_cast<double>(A.cols()) * std::sqrt(A(j, j) * A(k, k));
  };
  alone_.clear();
  coupled_.clear();
  for (Eigen::Index k = 0; k < basis_.cols(); ++k) {
    bool is_alone = k < lambda_.size();
    for (Eigen::Index j = 0; j < basis_.cols() && is_alone; ++j)
      is_alone = j == k || (is_small(reduced_loss_, j, k) && is_small(reduced_viscous_, j, k) &&
                            std::all_of(branches_.begin(), branches_.end(),
                                        [&](const Branch& b) { return is_small(b.reduced, j, k); }));
    (is_alone ? alone_ : coupled_).push_back(k);
  }
}

ComplexVector FrequencyResponse::residual(double omega, const ComplexVector& y) const {
  const Eigen::Index modes = lambda_.size(), added = basis_.cols() - modes;
  ComplexVector by_mass = -omega * omega * y;  // factors of the vectors M v
  for (Eigen::Index k = 0; k < modes; ++k) by_mass[k] += Complex(lambda_[k], omega * 2 * ratio_ * omega_[k]) * y[k];
  const auto combined = [](const auto& vectors, const ComplexVector& factors) {
    ComplexVector out(vectors.rows());
    out.real() = vectors * factors.real();
    out.imag() = vectors * factors.imag();
    return out;
  };
  ComplexVector r = load_ - combined(mass_times_basis_, by_mass);
  r -= product(stiffness_, combined(basis_.rightCols(added), y.tail(added)));
  if (loss_.empty() && viscous_.empty() && branches_.empty()) return r;
  const ComplexVector x = combined(basis_, y);
  for (const Branch& branch : branches_) r -= branch.factor(omega) * product(branch.stiffness, x);
  r -= Complex(0, 1) * (product(loss_, x) + omega * product(viscous_, x));
  return r;
}

Vector FrequencyResponse::without_rigid_motion(Vector x) const {
  x -= basis_.leftCols(zeros_) * (mass_times_basis_.leftCols(zeros_).transpose() * x);
  return x;
}

ComplexVector FrequencyResponse::response_to(const ComplexVector& force) {
  const auto response = [&](Vector f) {
    f -= mass_times_basis_.leftCols(zeros_) * (basis_.leftCols(zeros_).transpose() * f);
    Vector x(f.size());
    solver_->solve(f, x);
    return without_rigid_motion(std::move(x));
  };
  ComplexVector out(force.size());
  out.real() = response(force.real());
  out.imag() = response(force.imag());
  return out;
}

void FrequencyResponse::extend_basis(const VibrationRange& range) {
  if (!solver_) factor();
  add_parts(response_to(load_));
  constexpr int kPatience = 8;     // additions within which the error must fall by a fifth
  constexpr double kRigid = 1e-5;  // of the velocity norm: least size of the elastic part of x
  const double beyond = kModesBeyond * range.checks.back();
  std::vector<double> errors;
  for (;;) {
    find_coupled(range.rtol);
    error_ = 0;
    ComplexVector worst;
    for (const double frequency : range.checks) {
      const double omega = kTwoPi * frequency;
      const ComplexVector y = coordinates(frequency), r = residual(omega, y), z = response_to(r);
      const double size =
          std::max({std::sqrt(std::max(y.dot(reduced_stiffness_ * y).real(), 0.0)), kRigid * omega * y.norm(), 1e-150});
      // Modes beyond the basis amplify the static response to the residual.
      const double amplification = 1 / (1 - std::pow(frequency / beyond, 2));
      const double error = amplification * std::sqrt(std::max(z.dot(r).real(), 0.0)) / size;
      if (error > error_) error_ = error, worst = z;
    }
    errors.push_back(error_);
    if (error_ <= range.rtol) return;
    const auto tried = std::ssize(errors);
    end_ = basis_.cols() >= lambda_.size() + kMostAdded ? End::too_many : End::stagnated;
    const bool improves = tried <= kPatience || error_ <= 0.8 * errors[static_cast<std::size_t>(tried - 1 - kPatience)];
    if (end_ == End::too_many || !improves || !add_parts(worst)) return;
    end_ = End::converged;
  }
}

}  // namespace orthodyn
