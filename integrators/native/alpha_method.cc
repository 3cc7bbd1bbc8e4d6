#include "integrators/native/alpha_method.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {
// Share of the velocities that violate the constraints in the estimate. They are an error of the solution, which does
// not add up, unlike the local errors, which reach about ten times the tolerance.
constexpr double kViolationShare = 0.1;
constexpr double kMaxGrowth = 2;  // largest growth of the step: w cannot be extrapolated to a much longer one
}  // namespace

int AlphaParameters::order() const { return std::abs(gamma + theta() - 0.5) < 1e-12 ? 2 : 1; }

AlphaMethod::AlphaMethod(const std::string& name, const Model& model, const NewtonOptions& options,
                         const Scales& scales, const AlphaParameters& parameters)
    : OneStep(name, model, options, scales),
      p_(parameters),
      solver_(model, options, norm_, statistics_),
      predictor_(model.space()) {
  if (model.constraints() && !parameters.damps_fastest())
    throw ConfigError(
        "joints need a method that damps the fastest oscillations, as the forces of joints would oscillate: choose "
        "generalized_alpha with rho_inf below 1, hht_alpha with alpha below 0, or newmark with gamma above 1/2 and "
        "beta above gamma / 2");
}

// A growth by r multiplies the errors of the multipliers by r^2; they decay by alpha_f / (1 - alpha_f) in each step.
double AlphaMethod::largest_growth() const {
  constexpr double kDecay = 0.9, kSlowest = 0.25;
  const double usual = p_.theta() != 0 ? kMaxGrowth : OneStep::largest_growth();
  if (!model_.constraints()) return usual;
  return std::min(usual, std::sqrt(kDecay / std::max(p_.alpha_f / (1 - p_.alpha_f), kSlowest)));
}

void AlphaMethod::restarted() {
  solver_.restart();
  predictor_.clear();
  predictor_.add(now().t, now().a);
  w_ = now().a;
  last_h_ = 0;
}

bool AlphaMethod::attempt(double h) {
  const auto& [alpha_m, alpha_f, beta, gamma] = p_;
  const StepEnd& from = now();
  w0_ = w_;
  if (p_.theta() != 0 && last_h_ > 0) w0_ += p_.theta() * (std::min(h / last_h_, kMaxGrowth) - 1) * last_change_;
  Vector v0 = from.v;
  if (model_.constraints() && last_h_ > 0 && h != last_h_) {
    const double growth = std::min(h / last_h_, kMaxGrowth);
    v0 += (growth * growth - 1) * solver_.violation(from.t, from.q, from.v);
  }
  const double share = (1 - alpha_f) / (1 - alpha_m);  // w1 = share x1 + known terms
  w1_ = (alpha_f * from.a - alpha_m * w0_) / (1 - alpha_m);
  stage_.t = from.t + h;
  stage_.q = from.q + h * v0 + h * h * ((0.5 - beta) * w0_ + beta * w1_);
  stage_.v = v0 + h * ((1 - gamma) * w0_ + gamma * w1_);
  stage_.w_k = beta * share * h * h;
  stage_.w_d = gamma * share * h;

  next_.a.resize(from.a.size());
  predictor_.predict(stage_.t, next_.a);
  solver_.guess_multipliers(from.lambda);
  solver_.begin_step();
  if (!solver_.solve(stage_, next_.a, next_.q, next_.v)) return false;
  next_.lambda = solver_.multipliers();
  w1_ += share * next_.a;
  return true;
}

// Estimates the local errors by Taylor's formula, with q''' and q'''' from differences of accelerations (Zienkiewicz &
// Xie 1991 for Newmark, Hulbert & Jang 1995 for this family). In the first step the first difference, which is larger,
// replaces the unknown second difference.
void AlphaMethod::estimate(double h, VectorRef e_q, VectorRef e_v) {
  const double theta = p_.theta(), gamma = p_.gamma;
  const double lag = 0.5 * (1 - p_.alpha_f - theta * theta - (1 - p_.alpha_m) * (1 + 2 * theta));
  const double third = p_.beta + 0.5 * theta - 1.0 / 6;
  const double fourth = lag + 0.5 * (theta * theta + gamma * (1 + 2 * theta)) - 1.0 / 6;
  const auto change = w1_ - w0_;
  e_v = change;
  if (last_h_ > 0) e_v = 2 * h / (h + last_h_) * (change - h / last_h_ * last_change_);
  e_v = h * (fourth * e_v + (gamma + theta - 0.5) * change);
  e_q = h * h * third * change;
  solver_.filter(e_q, e_v);
  if (model_.constraints()) e_v += kViolationShare * solver_.violation(next_.t, next_.q, next_.v);
}

void AlphaMethod::accepted(double h) {
  last_change_ = w1_ - w0_;
  w_ = w1_;
  last_h_ = h;
  predictor_.add(next_.t, next_.a);
}

std::size_t AlphaMethod::method_bytes() const {
  return solver_.bytes() + predictor_.bytes() + 6 * static_cast<std::size_t>(model_.num_dofs()) * sizeof(double);
}

}  // namespace orthodyn
