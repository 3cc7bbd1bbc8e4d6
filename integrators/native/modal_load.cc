#include "integrators/native/modal_load.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/finite_force.h"
#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"

namespace orthodyn {
namespace {

constexpr double kLoadRoundOff = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

Vector StepLoad::rest_rate(double theta) const {
  return varies ? Vector(load_slope(rest, theta) / h) : Vector::Zero(rest.rows());
}

Vector StepLoad::rest_acceleration(double theta) const {
  return varies ? Vector(load_curvature(rest, theta) / (h * h)) : Vector::Zero(rest.rows());
}

Vector ModalLoad::force(double t) {
  const Measure measure(statistics_.force);
  const Vector zero = Vector::Zero(model_.num_dofs());
  Vector f(zero.size());
  model_.force(t, zero, zero, f);
  require_finite(model_, f);
  return f;
}

Vector ModalLoad::rest(const Vector& f, const Vector& modal) {
  const Measure measure(statistics_.solve);
  return basis_.static_rest(f, modal);
}

StepLoad ModalLoad::at(double t) {
  StepLoad out{t, 0, false, force(t), Eigen::MatrixXd::Zero(basis_.size(), kLoadTerms), {}};
  out.modal.col(0) = basis_.shapes().transpose() * out.first;
  out.rest = basis_.static_rest(out.first, out.modal.col(0));
  return out;
}

StepLoad ModalLoad::over(double t, double h) {
  StepLoad out{
      t, h, false, {}, Eigen::MatrixXd(basis_.size(), kLoadTerms), Eigen::MatrixXd(model_.num_dofs(), kLoadTerms)};
  for (Eigen::Index j = 0; j < kLoadTerms; ++j) {
    const Vector f = force(t + load_points()[static_cast<std::size_t>(j)] * h);
    if (j == 0) out.first = f;
    else if (f != out.first) out.varies = true;
    out.modal.col(j) = basis_.shapes().transpose() * f;
    out.rest.col(j) = j > 0 && f == out.first ? Vector(out.rest.col(0)) : rest(f, out.modal.col(j));
  }
  out.modal = load_coefficients(out.modal);
  if (out.varies) out.rest = load_coefficients(out.rest);
  else out.rest = Vector(out.rest.col(0));
  return out;
}

double ModalLoad::error(const StepLoad& load, const ScaledNorm& norm) {
  double largest = 0;
  for (const double theta :
       {golden_ratio_sample(2), 1 - golden_ratio_sample(5)}) {  // 0.236 and 0.910: between the points
    const Vector f = force(load.t + theta * load.h);
    if (!load.varies && f == load.first) continue;
    const Vector modal = basis_.shapes().transpose() * f;
    Vector off = modal - load.modal_at(theta);
    const double round_off = kLoadRoundOff * modal.lpNorm<Eigen::Infinity>();
    if (off.lpNorm<Eigen::Infinity>() <= round_off) off.setZero();
    Vector u_off = Vector::Zero(f.size());
    if (!basis_.is_complete()) {
      const Vector u = rest(f, modal);
      u_off = u - load.rest_at(theta);
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

}  // namespace orthodyn
