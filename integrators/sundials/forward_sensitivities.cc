#include "integrators/sundials/forward_sensitivities.h"

#include "integrators/run_checks.h"

namespace orthodyn::sundials {

ForwardSensitivities::ForwardSensitivities(SensitivityEquations& equations, const Model& model, N_Vector y,
                                           CallbackContext& callbacks, Statistics& statistics)
    : equations_(equations), model_(model), callbacks_(callbacks), statistics_(statistics) {
  const auto make = [&] {
    owned_.emplace_back(N_VClone(y));
    if (!owned_.back()) throw RunError("SUNDIALS could not allocate a vector", Reason::out_of_memory);
    return owned_.back().get();
  };
  for (int i = 0; i < equations.count(); ++i) {
    values_.push_back(make());
    derivatives_.push_back(make());
    tolerances_.push_back(make());
  }
}

std::vector<double> ForwardSensitivities::scales() const {
  std::vector<double> all;
  for (int i = 0; i < count(); ++i) all.push_back(equations_.scale(i));
  return all;
}

N_Vector* ForwardSensitivities::tolerances(double rtol, const Scales& scales) {
  for (int i = 0; i < count(); ++i) {
    const N_Vector one = tolerances_[static_cast<std::size_t>(i)];
    positions(one).setConstant(rtol * scales.position / equations_.scale(i));
    velocities(one).setConstant(rtol * scales.velocity / equations_.scale(i));
  }
  return tolerances_.data();
}

void ForwardSensitivities::start() {
  for (int i = 0; i < count(); ++i) {
    const State& start = equations_.initial(i);
    positions(values_[static_cast<std::size_t>(i)]) = start.q;
    velocities(values_[static_cast<std::size_t>(i)]) = start.v;
  }
}

void ForwardSensitivities::compute_force(int i, double t, N_Vector y, N_Vector y_dot, N_Vector s, VectorRef out) {
  const Measure measure(statistics_.sensitivity);
  equations_.force(i, t, positions(y), velocities(y), velocities(y_dot), positions(s), velocities(s), out);
  require_finite(model_, out);
}

void ForwardSensitivities::make_consistent(double t, N_Vector y, N_Vector y_dot) {
  for (int i = 0; i < count(); ++i) {
    const N_Vector s = values_[static_cast<std::size_t>(i)], s_dot = derivatives_[static_cast<std::size_t>(i)];
    positions(s_dot) = velocities(s);
    compute_force(i, t, y, y_dot, s, velocities(s_dot));
    model_.solve_mass(velocities(s_dot));
  }
}

int ForwardSensitivities::first_order(int i, double t, N_Vector y, N_Vector y_dot, N_Vector s, N_Vector s_dot) {
  return guarded(callbacks_, [&] {
    positions(s_dot) = velocities(s);
    compute_force(i, t, y, y_dot, s, velocities(s_dot));
    model_.solve_mass(velocities(s_dot));
  });
}

int ForwardSensitivities::residual(double t, N_Vector y, N_Vector y_dot, N_Vector* s, N_Vector* s_dot, N_Vector* out) {
  return guarded(callbacks_, [&] {
    Vector momentum(model_.num_dofs());
    for (int i = 0; i < count(); ++i) {
      positions(out[i]) = positions(s_dot[i]) - velocities(s[i]);
      compute_force(i, t, y, y_dot, s[i], velocities(out[i]));
      model_.multiply_mass(velocities(s_dot[i]), momentum);
      velocities(out[i]) = momentum - velocities(out[i]);
    }
  });
}

std::size_t ForwardSensitivities::bytes() const {
  return owned_.empty() ? 0 : owned_.size() * static_cast<std::size_t>(view(owned_[0].get()).size()) * sizeof(double);
}

}  // namespace orthodyn::sundials
