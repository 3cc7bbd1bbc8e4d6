#include "integrators/sundials/newton_system.h"

#include "integrators/scaled_norm.h"

namespace orthodyn::sundials {

NewtonSystem::NewtonSystem(const Model& model, const Options& options, const Scales& scales, Statistics& statistics,
                           CallbackContext& callbacks)
    : model_(model),
      options_(options),
      scales_(scales),
      statistics_(statistics),
      callbacks_(callbacks),
      momentum_(model.num_dofs()) {
  if (options.is_full()) full_.emplace(model);
  else reduced_.emplace(model, options.linear_solver, options.tangent(), statistics);
  if (reduced_) reduced_->set_newton_tolerance(0);
}

void NewtonSystem::create_first_order(SUNContext context, std::function<double()> gamma) {
  if (full_) return create_full(context);
  create_reduced(context, std::move(gamma), [this](N_Vector x, N_Vector b) {
    model_.multiply_mass(velocities(b), momentum_);
    reduced_->solve(positions(b), momentum_, positions(x), velocities(x));
  });
}

void NewtonSystem::create_residual(SUNContext context) {
  if (full_) return create_full(context);
  create_reduced(
      context, [this] { return gamma_; },
      [this](N_Vector x, N_Vector b) {
        momentum_ = gamma_ * velocities(b);
        positions(x) = gamma_ * positions(b);
        reduced_->solve(positions(x), momentum_, positions(x), velocities(x));
      });
}

void NewtonSystem::create_reduced(SUNContext context, std::function<double()> gamma,
                                  std::function<void(N_Vector, N_Vector)> solve) {
  matrix_ = make_placeholder_matrix(context);
  functions_.setup = [this, gamma = std::move(gamma)] {
    bool factored = false;
    const int thrown = guarded(callbacks_, [&] { factored = reduced_->factor(gamma()); });
    return thrown ? thrown : factored ? 0 : 1;
  };
  functions_.iterative = reduced_->is_iterative();
  functions_.solve = [this, solve = std::move(solve)](N_Vector x, N_Vector b, double tolerance) {
    const ScaledNorm norm(options_.rtol, scales_);
    reduced_->set_newton_tolerance(norm.root_mean_square_at(tolerance, reduced_->gamma(), 1));
    return guarded(callbacks_, [&] { solve(x, b); });
  };
  solver_ = make_solver_adapter(functions_, context);
}

void NewtonSystem::create_full(SUNContext context) {
  matrix_ = full_->make_matrix(context);
  klu_ = make_klu(matrix_.get(), context);
  functions_.setup = [this] {
    const Measure measure(statistics_.factorization);
    return static_cast<int>(SUNLinSolSetup(klu_.get(), matrix_.get()));
  };
  functions_.solve = [this](N_Vector x, N_Vector b, double) {
    const Measure measure(statistics_.solve);
    return static_cast<int>(SUNLinSolSolve(klu_.get(), matrix_.get(), x, b, 0));
  };
  solver_ = make_solver_adapter(functions_, context);
}

int NewtonSystem::linearize(double t, N_Vector y, bool keep, sunbooleantype* renewed) {
  *renewed = !keep;
  return guarded(callbacks_, [&] {
    if (!keep) reduced_->linearize(t, positions(y), velocities(y));
  });
}

int NewtonSystem::fill_jacobian(double t, N_Vector y, SUNMatrix J) {
  return guarded(callbacks_, [&] {
    linearize_full(t, y);
    full_->fill_first_order(linearization_, J);
  });
}

int NewtonSystem::linearize_residual(double t, double cj, N_Vector y, SUNMatrix J) {
  return guarded(callbacks_, [&] {
    if (full_) {
      linearize_full(t, y);
      full_->fill_ida(cj, linearization_, J);
    } else {
      gamma_ = 1 / cj;
      reduced_->linearize(t, positions(y), velocities(y));
    }
  });
}

void NewtonSystem::linearize_full(double t, N_Vector y) {
  const Measure measure(statistics_.tangent);
  model_.linearize(t, positions(y), velocities(y), options_.tangent(), linearization_);
}

}  // namespace orthodyn::sundials
