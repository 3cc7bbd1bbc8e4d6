#include "integrators/native/alpha_method.h"

#include <cmath>

namespace orthodyn {

int AlphaParameters::order() const { return std::abs(gamma + theta() - 0.5) < 1e-12 ? 2 : 1; }

AlphaMethod::AlphaMethod(const std::string& name, const Model& model, const NewtonOptions& options,
                         const Scales& scales, const AlphaParameters& parameters)
    : OneStep(name, model, options, scales), p_(parameters), solver_(model, options, norm_, statistics_),
      a_(model.num_dofs()), x_(model.num_dofs()) {}

void AlphaMethod::restarted() {
  solver_.restart();
  past_.clear();
  past_.add(now().t, now().a);
  last_h_ = 0;
}

bool AlphaMethod::attempt(double h) {
  const auto& [alpha_m, alpha_f, beta, gamma] = p_;
  const Knot& from = now();
  a_ = from.a;
  if (p_.theta() != 0 && last_h_ > 0) a_ += p_.theta() * (h / last_h_ - 1) * last_change_;
  // a1 = (x - alpha_m a0) / (1 - alpha_m)
  const double x_share = 1 / (1 - alpha_m), a_share = -alpha_m * x_share, new_state = 1 - alpha_f;
  stage_.t = from.t + new_state * h;
  stage_.q = from.q + new_state * h * (from.v + h * (0.5 - beta + beta * a_share) * a_);
  stage_.v = from.v + new_state * h * (1 - gamma + gamma * a_share) * a_;
  stage_.w_k = new_state * beta * x_share * h * h;
  stage_.w_d = new_state * gamma * x_share * h;

  past_.predict(from.t + (1 - alpha_m) * h, x_);
  solver_.begin_step();
  if (!solver_.solve(stage_, x_, next_.q, next_.v)) return false;
  next_.a = x_share * x_ + a_share * a_;
  next_.q = from.q + h * from.v + h * h * ((0.5 - beta) * a_ + beta * next_.a);
  next_.v = from.v + h * ((1 - gamma) * a_ + gamma * next_.a);
  return true;
}

// The local errors by Taylor's formula, q''' and q'''' from differences of accelerations: of q as Zienkiewicz & Xie
// (1991) for Newmark, Hulbert & Jang (1995) for this family; of v likewise. In the first step, where no second
// difference is known, the first one stands for it, which is larger.
void AlphaMethod::estimate(double h, VectorRef e_q, VectorRef e_v) {
  const double theta = p_.theta(), gamma = p_.gamma;
  const double lag = 0.5 * (1 - p_.alpha_f - theta * theta - (1 - p_.alpha_m) * (1 + 2 * theta));
  const double third = p_.beta + 0.5 * theta - 1.0 / 6;
  const double fourth = lag + 0.5 * (theta * theta + gamma * (1 + 2 * theta)) - 1.0 / 6;
  const auto change = next_.a - a_;
  e_v = change;
  if (last_h_ > 0) e_v = 2 * h / (h + last_h_) * (change - h / last_h_ * last_change_);
  e_v = h * (fourth * e_v + (gamma + theta - 0.5) * change);
  e_q = h * h * third * change;
  solver_.filter(e_q, e_v);
}

void AlphaMethod::accepted(double h) {
  last_change_ = next_.a - a_;
  last_h_ = h;
  past_.add(next_.t, next_.a);
}

std::size_t AlphaMethod::method_bytes() const {
  return solver_.bytes() + 7 * static_cast<std::size_t>(model_.num_dofs()) * sizeof(double);
}

}  // namespace orthodyn
