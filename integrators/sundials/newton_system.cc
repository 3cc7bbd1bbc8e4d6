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
  if (model.internal_variables()) {
    if (options.is_full())
      throw ConfigError("linear_solver: klu_full is not available with viscoelastic materials; use klu or auto");
    internal_.emplace(model);
    extra_.internals = internal_->internal().size();
  }
  if (const Constraints* constraints = model.constraints()) {
    if (options.is_full()) throw ConfigError("linear_solver: klu_full is not available with joints; use klu or auto");
    extra_.constraints = constraints->size();
    dlambda_.resize(constraints->size());
    constraints_.emplace(*constraints);
  }
  if (options.is_full()) full_.emplace(model);
  else
    reduced_.emplace(internal_ ? static_cast<const Model&>(*internal_) : model, options.linear_solver,
                     options.tangent(), statistics);
  if (reduced_) reduced_->set_newton_tolerance(0);
}

void NewtonSystem::create_first_order(SUNContext context, std::function<double()> gamma) {
  if (full_) return create_full(context);
  extra_.constraints = 0;
  create_reduced(context, std::move(gamma), [this](N_Vector x, N_Vector b) {
    model_.multiply_mass(velocities(b, extra_), momentum_);
    positions(x, extra_) = positions(b, extra_);
    solve_reduced(x, b, 1);
  });
}

void NewtonSystem::create_residual(SUNContext context) {
  if (full_) return create_full(context);
  create_reduced(
      context, [this] { return gamma_; },
      [this](N_Vector x, N_Vector b) {
        momentum_ = gamma_ * velocities(b, extra_);
        positions(x, extra_) = gamma_ * positions(b, extra_);
        solve_reduced(x, b, gamma_);
      });
}

void NewtonSystem::create_reduced(SUNContext context, std::function<double()> gamma,
                                  std::function<void(N_Vector, N_Vector)> solve) {
  matrix_ = make_placeholder_matrix(context);
  library_gamma_ = std::move(gamma);
  functions_.setup = [this] {
    bool factored = false;
    const int thrown = guarded(callbacks_, [&] {
      factored = reduced_->factor(library_gamma_());
      if (factored && constraints_)
        factored = constraints_->factor(
            [this](const Vector& right, Vector& solution) { reduced_->NewtonMatrix::solve(right, solution); });
    });
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

void NewtonSystem::solve_reduced(N_Vector x, N_Vector b, double scale) {
  auto dq = positions(x, extra_), dv = velocities(x, extra_);
  const double gamma = reduced_->gamma();
  if (extra_.constraints > 0) {
    b_1_ = velocity_multipliers(b, extra_);
    b_2_ = position_multipliers(b, extra_);
    constraints_->before(gamma, b_1_, b_2_, dq, position_multipliers(x, extra_));
  } else if (constraints_) {
    b_1_ = constraints_->product(velocities(b, extra_));
  }
  if (internal_) {
    const Vector& tau = internal_->internal().relaxation_times();
    w_ = scale * internal_part(b, extra_).array() * tau.array() / (tau.array() + gamma);
    work_.resize(momentum_.size());
    internal_->internal().force_change(t_, q_, w_, work_);
    momentum_ += gamma * work_;
  }
  reduced_->solve(dq, momentum_, dq, dv);
  if (constraints_) {
    constraints_->after(gamma, b_1_, dq, dv, dlambda_);
    if (extra_.constraints > 0) velocity_multipliers(x, extra_) = dlambda_;
  }
  if (internal_) {
    const Vector& tau = internal_->internal().relaxation_times();
    auto dz = internal_part(x, extra_);
    internal_->internal().strain_change(t_, q_, dq, dz);
    dz = w_.array() + gamma / (tau.array() + gamma) * dz.array();
  }
}

void NewtonSystem::linearize_reduced(double t, N_Vector y, double gamma) {
  if (internal_) {
    z_ = internal_part(y, extra_);
    internal_->set(z_.data(), gamma);
    t_ = t;
    q_ = positions(y, extra_);
  }
  if (constraints_) constraints_->linearize(t, positions(y, extra_));
  reduced_->linearize(t, positions(y, extra_), velocities(y, extra_));
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
  const bool is_kept = keep && !internal_;  // K of internal variables depends on gamma
  *renewed = !is_kept;
  return guarded(callbacks_, [&] {
    if (!is_kept) linearize_reduced(t, y, library_gamma_());
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
      linearize_reduced(t, y, gamma_);
    }
  });
}

void NewtonSystem::linearize_full(double t, N_Vector y) {
  const Measure measure(statistics_.tangent);
  model_.linearize(t, positions(y), velocities(y), options_.tangent(), linearization_);
}

}  // namespace orthodyn::sundials
