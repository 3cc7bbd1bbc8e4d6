#include "integrators/native/modal_load.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/run_checks.h"
#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"

namespace orthodyn {
namespace {

constexpr double kLoadRoundOff = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

Vector StepLoad::correction_rate(double theta) const {
  return varies ? Vector(polynomial_slope(correction, theta) / h) : Vector::Zero(correction.rows());
}

Vector StepLoad::correction_acceleration(double theta) const {
  return varies ? Vector(polynomial_curvature(correction, theta) / (h * h)) : Vector::Zero(correction.rows());
}

Vector ModalLoad::force(double t) {
  const Measure measure(statistics_.force);
  const Vector zero = Vector::Zero(model_.num_dofs());
  Vector f(zero.size());
  model_.force(t, zero, zero, f);
  require_finite(model_, f);
  return f;
}

Vector ModalLoad::correction(const Vector& f, const Vector& modal) {
  const Measure measure(statistics_.solve);
  return basis_.static_correction(f, modal);
}

StepLoad ModalLoad::at(double t) {
  StepLoad out{t, 0, false, force(t), Eigen::MatrixXd::Zero(basis_.size(), kLoadTerms), {}};
  out.modal.col(0) = basis_.shapes().transpose() * out.first;
  out.correction = basis_.static_correction(out.first, out.modal.col(0));
  return out;
}

StepLoad ModalLoad::over(double t, double h) {
  StepLoad out{
      t, h, false, {}, Eigen::MatrixXd(basis_.size(), kLoadTerms), Eigen::MatrixXd(model_.num_dofs(), kLoadTerms)};
  for (Eigen::Index j = 0; j < kLoadTerms; ++j) {
    const Vector f = force(t + chebyshev_points()[static_cast<std::size_t>(j)] * h);
    if (j == 0) out.first = f;
    else if (f != out.first) out.varies = true;
    out.modal.col(j) = basis_.shapes().transpose() * f;
    out.correction.col(j) = j > 0 && f == out.first ? Vector(out.correction.col(0)) : correction(f, out.modal.col(j));
  }
  out.modal = polynomial_coefficients(out.modal);
  if (out.varies) out.correction = polynomial_coefficients(out.correction);
  else out.correction = Vector(out.correction.col(0));
  return out;
}

double ModalLoad::error(const StepLoad& load, const ScaledNorm& norm) {
  double largest = 0;
  // 0.236 and 0.910, between the interpolation points.
  for (const double theta : {golden_ratio_sample(2), 1 - golden_ratio_sample(5)}) {
    const Vector f = force(load.t + theta * load.h);
    if (!load.varies && f == load.first) continue;
    const Vector modal = basis_.shapes().transpose() * f;
    Vector off = modal - load.modal_at(theta);
    const double round_off = kLoadRoundOff * modal.lpNorm<Eigen::Infinity>();
    if (off.lpNorm<Eigen::Infinity>() <= round_off) off.setZero();
    Vector u_off = Vector::Zero(f.size());
    if (!basis_.is_complete()) {
      const Vector u = correction(f, modal);
      u_off = u - load.correction_at(theta);
      if (u_off.lpNorm<Eigen::Infinity>() <= 1e3 * kLoadRoundOff * u.lpNorm<Eigen::Infinity>()) u_off.setZero();
    }
    const Vector phase = (0.5 * load.h * basis_.lambda().cwiseSqrt()).cwiseMax(1);
    const Vector e_q = basis_.shapes() * (0.5 * load.h * load.h * off.cwiseQuotient(phase)) + u_off;
    const Vector e_v = basis_.shapes() * (load.h * off) + u_off / load.h;
    largest = std::max(largest, norm(e_q, e_v));
  }
  if (!std::isfinite(largest)) throw RecoverableError("the response is not finite");
  return largest;
}

ModalState modal_state(const ModalBasis& basis, const State& state) {
  return {basis.coordinates(state.q), basis.coordinates(state.v)};
}

ModalState modal_state_after(const ModalBasis& basis, const ModalState& begin, const StepLoad& load, double tau) {
  ModalState now{Vector(basis.size()), Vector(basis.size())};
  for (Eigen::Index k = 0; k < basis.size(); ++k) {
    const Oscillation o = oscillate(basis.damping()[k], basis.lambda()[k], {begin.r[k], begin.rate[k]},
                                    load.modal.row(k).transpose(), load.h, tau);
    now.r[k] = o.r;
    now.rate[k] = o.rate;
  }
  return now;
}

Vector modal_equilibrium(const ModalBasis& basis, const Vector& modal) {
  Vector at_rest = modal;
  for (Eigen::Index k = 0; k < at_rest.size(); ++k)
    at_rest[k] = basis.lambda()[k] > 0 ? modal[k] / basis.lambda()[k] : 0;
  return at_rest;
}

}  // namespace orthodyn
