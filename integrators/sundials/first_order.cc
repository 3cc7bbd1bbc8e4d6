#include "integrators/sundials/first_order.h"

#include "integrators/finite_force.h"

namespace orthodyn::sundials {

FirstOrderIntegrator::FirstOrderIntegrator(const std::string& name, const Model& model, const Settings& settings)
    : SundialsIntegrator(name, model, settings) {
  if (settings.full && !model.traits().lumped_mass)
    throw ConfigError("linear_solver klu_full under " + name +
                      " needs `mass: lumped` (the inverse of a consistent mass is dense); use ida_bdf, or klu or "
                      "cholmod");
}

int FirstOrderIntegrator::evaluate(double t, N_Vector y, N_Vector y_dot) {
  positions(y_dot) = velocities(y);
  return evaluate_acceleration(model_, t, y, velocities(y_dot));
}

int FirstOrderIntegrator::evaluate_acceleration(const Model& model, double t, N_Vector y, VectorRef a) {
  return guarded(callback_context_, [&] {
    const Measure measure(statistics_.force);
    model.force(t, positions(y), velocities(y), a);
    require_finite(model, a);
    model.solve_mass(a);
  });
}

int FirstOrderIntegrator::linearize_reduced(double t, N_Vector y, bool keep, sunbooleantype* renewed) {
  *renewed = !keep;
  return guarded(callback_context_, [&] {
    if (!keep) reduced_->linearize(t, positions(y), velocities(y));
  });
}

int FirstOrderIntegrator::fill_full(double t, N_Vector y, SUNMatrix J) {
  return guarded(callback_context_, [&] {
    linearize_full(t, y);
    full_->fill_first_order(linearization_, J);
  });
}

void FirstOrderIntegrator::make_first_order_solver(std::function<double()> gamma) {
  make_reduced_solver(std::move(gamma), [this](N_Vector x, N_Vector b) {
    model_.multiply_mass(velocities(b), momentum_);
    reduced_->solve(positions(b), momentum_, positions(x), velocities(x));
  });
}

}  // namespace orthodyn::sundials
