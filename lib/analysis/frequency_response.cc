#include "lib/analysis/frequency_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kDependent = 1e-8;  // M-norm of the part outside of the basis, relative to the whole direction
constexpr int kMostAdded = 200;      // directions besides the modes

using Complex = std::complex<double>;

}  // namespace

FrequencyResponse::FrequencyResponse(const Model& model, const State& about, const Modes& modes,
                                     const ComplexVector& load, VibrationDamping damping, const VibrationRange& range)
    : model_(model), loss_(std::move(damping.loss)), ratio_(damping.ratio), load_(load) {
  if (!modes.modes.empty() && modes.modes.front().lambda < 0)
    throw ConfigError("analysis",
                      "harmonic: the body is unstable under its steady loads, so that no steady vibration "
                      "about this state exists; reduce them");
  const auto entries = model.pattern().row.size();
  Linearization at;
  model.linearize(about.t, about.q, Vector::Zero(about.q.size()), TangentKind::exact, at);
  stiffness_.resize(entries);
  mass_.resize(entries);
  viscous_.resize(entries);
  model.combine({0, 0, 1}, at, stiffness_.data());
  model.combine({1, 0, 0}, at, mass_.data());
  model.combine({0, 1, 0}, at, viscous_.data());
  if (std::all_of(viscous_.begin(), viscous_.end(), [](double d) { return d == 0; })) viscous_.clear();
  omega_.resize(std::ssize(modes.modes));
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    omega_[static_cast<Eigen::Index>(k)] = std::sqrt(modes.modes[k].lambda);
    add(modes.modes[k].shape);
  }
  add_until(range);
}

Vector FrequencyResponse::product(const Values& values, const Vector& x) const {
  Vector y = Vector::Zero(x.size());
  if (!values.empty()) model_.multiply_matrix(values.data(), x, y);
  return y;
}

// K + s M with s = 0 if K is positive definite.
void FrequencyResponse::factor() {
  solver_ = make_solver_for(model_.pattern());
  const bool has_zero_modes = omega_.size() > 0 && omega_[0] == 0;
  if (!has_zero_modes && solver_->factor(stiffness_.data()) == FactorStatus::ok) return;
  const double highest = omega_.size() > 0 ? omega_[omega_.size() - 1] : 0;
  if (highest == 0)
    throw RunError(
        "the stiffness is singular, and no natural frequency above zero is known: raise 'to', or clamp the body");
  shift_ = highest * highest;
  for (const double omega : omega_)
    if (omega > 0) shift_ = std::min(shift_, omega * omega);
  Values shifted = stiffness_;
  for (std::size_t k = 0; k < shifted.size(); ++k) shifted[k] += shift_ * mass_[k];
  solver_ = make_solver_for(model_.pattern());
  if (solver_->factor(shifted.data()) != FactorStatus::ok)
    throw RunError("the stiffness about the steady loads is not positive definite: reduce the loads");
}

// Makes the direction M-orthonormal to the basis, and adds it. False if it lies in the basis.
bool FrequencyResponse::add(Vector direction) {
  const Eigen::Index size = basis_.cols();
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
  const auto project = [&](const Values& values, Eigen::MatrixXd& reduced) {
    const Vector column = basis_.transpose() * product(values, basis_.col(size));
    reduced.conservativeResize(size + 1, size + 1);
    reduced.col(size) = column;
    reduced.row(size) = column.transpose();
  };
  project(stiffness_, reduced_stiffness_);
  project(viscous_, reduced_viscous_);
  project(loss_, reduced_loss_);
  if (size < omega_.size()) reduced_viscous_(size, size) += 2 * ratio_ * omega_[size];
  reduced_load_.conservativeResize(size + 1);
  reduced_load_[size] = Complex(basis_.col(size).dot(load_.real()), basis_.col(size).dot(load_.imag()));
  return true;
}

Eigen::MatrixXcd FrequencyResponse::projected(double omega) const {
  Eigen::MatrixXcd A(basis_.cols(), basis_.cols());
  A.real() = reduced_stiffness_;
  A.imag() = reduced_loss_ + omega * reduced_viscous_;
  A.diagonal().array() -= omega * omega;
  return A;
}

ComplexVector FrequencyResponse::coordinates(double frequency) const {
  return projected(kTwoPi * frequency).partialPivLu().solve(reduced_load_);
}

double FrequencyResponse::loss_factor(int mode) const {
  const double omega = omega_[mode];
  if (omega == 0) return 0;
  return (omega * reduced_viscous_(mode, mode) + reduced_loss_(mode, mode)) / (omega * omega);
}

ComplexVector FrequencyResponse::residual(double omega, const ComplexVector& y) const {
  const Vector real = basis_ * y.real(), imaginary = basis_ * y.imag();
  ComplexVector modal = ComplexVector::Zero(y.size());  // the damping ratio acts on the modes
  for (Eigen::Index k = 0; k < omega_.size(); ++k) modal[k] = 2 * ratio_ * omega_[k] * y[k];
  const auto times = [&](const Values& values) {
    ComplexVector out(real.size());
    out.real() = product(values, real);
    out.imag() = product(values, imaginary);
    return out;
  };
  ComplexVector damping = times(viscous_);
  if (ratio_ > 0) {
    damping.real() += mass_times_basis_ * modal.real();
    damping.imag() += mass_times_basis_ * modal.imag();
  }
  return load_ - times(stiffness_) + omega * omega * times(mass_) - Complex(0, 1) * (times(loss_) + omega * damping);
}

ComplexVector FrequencyResponse::response_to(const ComplexVector& force) {
  Vector real(force.size()), imaginary(force.size());
  solver_->solve(Vector(force.real()), real);
  solver_->solve(Vector(force.imag()), imaginary);
  ComplexVector out(force.size());
  out.real() = real;
  out.imag() = imaginary;
  return out;
}

void FrequencyResponse::add_until(const VibrationRange& range) {
  if (omega_.size() == model_.num_dofs()) return;  // the modes are a complete basis
  factor();
  const auto add_parts = [&](const ComplexVector& x) {
    const bool real = add(x.real()), imaginary = add(x.imag());
    return real || imaginary;
  };
  add_parts(response_to(load_));
  const double beyond = kModesBeyond * range.checks.back();
  for (;;) {
    error_ = 0;
    ComplexVector worst;
    for (const double frequency : range.checks) {
      const double omega = kTwoPi * frequency;
      const ComplexVector y = coordinates(frequency), r = residual(omega, y), z = response_to(r);
      Eigen::MatrixXd energy = reduced_stiffness_;
      energy.diagonal().array() += shift_;
      const double size = std::sqrt(std::max(y.dot(energy * y).real(), 1e-300));
      // Modes beyond the basis amplify the static response to the residual.
      const double amplification = 1 / (1 - std::pow(frequency / beyond, 2));
      const double error = amplification * std::sqrt(std::max(z.dot(r).real(), 0.0)) / size;
      if (error > error_) error_ = error, worst = z;
    }
    if (error_ <= range.rtol || basis_.cols() >= omega_.size() + kMostAdded || !add_parts(worst)) return;
  }
}

}  // namespace orthodyn
