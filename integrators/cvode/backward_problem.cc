#include "integrators/cvode/backward_problem.h"

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>

#include <algorithm>
#include <cmath>

namespace orthodyn::sundials {

namespace {

// Tolerance of the adjoint equations over that of the motion. A force on one unknown shakes all modes, also those that
// the motion does not have; their errors hardly change the integral. Beam without damping, 4,950 unknowns, rtol 1e-4:
// with 10 (100) the derivatives change by 0.02 % (0.3 %) of the largest, in 9,400 (1,500) steps instead of 26,100.
constexpr double kTolerance = 30;

BackwardProblem* self_of(void* user) { return static_cast<BackwardProblem*>(user); }

}  // namespace

BackwardProblem::BackwardProblem(void* memory, const Model& model, const Options& options, int max_order,
                                 const Scales& scales, AdjointEquations& equations, N_Vector y,
                                 CallbackContext& callbacks, Statistics& statistics, SUNContext context)
    : memory_(memory),
      model_(model),
      options_(options),
      max_order_(max_order),
      scales_(scales),
      equations_(equations),
      callbacks_(callbacks),
      statistics_(statistics),
      context_(context),
      matrix_(model, options.linear_solver, TangentKind::exact, statistics),
      adjoint_(N_VClone(y)),
      tolerance_(N_VClone(y)),
      integral_(make_vector(equations.count(), context)),
      work_(model.num_dofs()) {
  if (!adjoint_ || !tolerance_) throw RunError("SUNDIALS could not allocate a vector", Reason::out_of_memory);
  N_VConst(0, adjoint_.get());
  N_VConst(0, tolerance_.get());
}

void BackwardProblem::require(int flag) const {
  if (flag >= 0) return;
  if (callbacks_.failure) std::rethrow_exception(callbacks_.failure);
  throw RunError("the adjoint equations could not be integrated: " + callbacks_.message +
                 callbacks_.recoverable_cause.in_brackets());
}

void BackwardProblem::jump(std::size_t k, const State& state) {
  Vector by_position(model_.num_dofs()), by_velocity(model_.num_dofs());
  equations_.source(k, state, by_position, by_velocity);
  Vector b = by_velocity;
  model_.solve_mass(b);
  positions(adjoint_.get()) += by_position;
  velocities(adjoint_.get()) += b;
  // Root mean squares over all unknowns: a force on one of them that has the frequency of the motion, and the impulse
  // of this force on one unknown of mean mass.
  const auto n = static_cast<double>(model_.num_dofs());
  const double omega = scales_.velocity / scales_.position;
  // The forces at the two ends of a gauge nearly cancel: a smaller force on one unknown has the same effect.
  double force = by_position.lpNorm<1>();
  if (const auto size = equations_.size()) force = std::min(force, *size / scales_.position);
  const double impulse = force / omega + by_velocity.lpNorm<1>();
  model_.multiply_mass(Vector::Ones(model_.num_dofs()), work_);
  const double mean_mass = work_.sum() / n, share = kTolerance * options_.rtol / std::sqrt(n);
  positions(tolerance_.get()) = positions(tolerance_.get()).cwiseMax(share * omega * impulse);
  velocities(tolerance_.get()) = velocities(tolerance_.get()).cwiseMax(share * impulse / mean_mass);
  is_started_ ? restart(state.t) : start(state.t);
}

void BackwardProblem::restart(double t) {
  steps_ += steps_of_library();
  require(CVodeReInitB(memory_, which_, t, adjoint_.get()));
  require(CVodeSVtolerancesB(memory_, which_, kTolerance * options_.rtol, tolerance_.get()));
  require(CVodeQuadReInitB(memory_, which_, integral_.get()));
}

void BackwardProblem::start(double t) {
  is_started_ = true;
  require(CVodeCreateB(memory_, CV_BDF, &which_));
  require(CVodeInitB(
      memory_, which_,
      [](sunrealtype time, N_Vector y, N_Vector y_b, N_Vector y_b_dot, void* user) {
        return self_of(user)->right_hand_side(y, y_b, y_b_dot, time);
      },
      t, adjoint_.get()));
  require(CVodeSetUserDataB(memory_, which_, this));
  require(CVodeSVtolerancesB(memory_, which_, kTolerance * options_.rtol, tolerance_.get()));
  require(CVodeSetMaxOrdB(memory_, which_, max_order_));
  require(CVodeSetMaxNumStepsB(memory_, which_, options_.max_steps));
  placeholder_ = make_placeholder_matrix(context_);
  functions_.setup = [this] {
    bool factored = false;
    const double g = -gamma_;
    const int thrown = guarded(callbacks_, [&] { factored = matrix_.factor({1, g, g * g}); });
    return thrown ? thrown : factored ? 0 : 1;
  };
  functions_.solve = [this](N_Vector x, N_Vector r, double) {
    return guarded(callbacks_, [&] {
      const double g = matrix_.weights().damping;
      model_.multiply_mass(velocities(r), work_);
      work_ += g * positions(r);
      const Vector r_a = positions(r);  // r and x may be the same vector
      matrix_.solve(work_, velocities(x));
      matrix_.multiply_stiffness(velocities(x), work_);
      positions(x) = r_a - g * work_;
    });
  };
  solver_ = make_solver_adapter(functions_, context_);
  require(CVodeSetLinearSolverB(memory_, which_, solver_.get(), placeholder_.get()));
  require(CVodeSetLinSysFnB(memory_, which_,
                            [](sunrealtype time, N_Vector y, N_Vector, N_Vector, SUNMatrix, sunbooleantype keep,
                               sunbooleantype* renewed, sunrealtype gamma, void* user, N_Vector, N_Vector,
                               N_Vector) { return self_of(user)->linearize(time, y, keep, gamma, renewed); }));
  require(CVodeQuadInitB(
      memory_, which_,
      [](sunrealtype time, N_Vector y, N_Vector y_b, N_Vector out, void* user) {
        return self_of(user)->products(time, y, y_b, out);
      },
      integral_.get()));
  set_quadrature_tolerances();
}

void BackwardProblem::set_quadrature_tolerances() {
  const bool is_of_position = positions(tolerance_.get()).maxCoeff() > 0;
  const double size = equations_.size().value_or(is_of_position ? scales_.position : scales_.velocity);
  const OwnedVector absolute(N_VClone(integral_.get()));
  for (int i = 0; i < equations_.count(); ++i)
    view(absolute.get())[i] = kTolerance * options_.rtol * size / equations_.scale(i);
  require(CVodeSetQuadErrConB(memory_, which_, 1));
  require(CVodeQuadSVtolerancesB(memory_, which_, kTolerance * options_.rtol, absolute.get()));
}

void BackwardProblem::integrate_to(double t) {
  require(CVodeB(memory_, t, CV_NORMAL));
  sunrealtype reached = 0;
  require(CVodeGetB(memory_, which_, &reached, adjoint_.get()));
  require(CVodeGetQuadB(memory_, which_, &reached, integral_.get()));
}

AdjointSolution BackwardProblem::solution() {
  AdjointSolution out;
  // The library integrates backward, from 0: the integral over the time span is the negative of its result.
  out.integral = -view(integral_.get());
  out.a = positions(adjoint_.get());
  out.momentum.resize(model_.num_dofs());
  model_.multiply_mass(velocities(adjoint_.get()), out.momentum);
  out.backward_steps = steps_ + steps_of_library();
  out.rtol = kTolerance * options_.rtol;
  return out;
}

long BackwardProblem::steps_of_library() const {
  long steps = 0;
  if (void* const own = CVodeGetAdjCVodeBmem(memory_, which_)) CVodeGetNumSteps(own, &steps);
  return steps;
}

int BackwardProblem::linearize(double t, N_Vector y, bool keep, double gamma, sunbooleantype* renewed) {
  *renewed = !keep;
  gamma_ = gamma;
  return guarded(callbacks_, [&] {
    if (!keep) matrix_.linearize(t, positions(y), velocities(y));
  });
}

int BackwardProblem::right_hand_side(N_Vector y, N_Vector y_b, N_Vector y_b_dot, double t) {
  return guarded(callbacks_, [&] {
    const auto a = positions(y_b), b = velocities(y_b);
    if (!is_linearized_) {  // D is constant
      const Measure measure(statistics_.tangent);
      model_.linearize(t, positions(y), velocities(y), TangentKind::exact, tangent_);
      damping_.resize(model_.pattern().row.size());
      model_.combine({0, 1, 0}, tangent_, damping_.data());
      if (std::all_of(damping_.begin(), damping_.end(), [](double d) { return d == 0; })) damping_.clear();
      is_linearized_ = true;
    }
    multiply_stiffness(t, y, b, positions(y_b_dot));
    velocities(y_b_dot).setZero();
    if (!damping_.empty()) model_.multiply_matrix(damping_.data(), b, velocities(y_b_dot));
    velocities(y_b_dot) -= a;
    model_.solve_mass(velocities(y_b_dot));
  });
}

void BackwardProblem::multiply_stiffness(double t, N_Vector y, const ConstVectorRef& b, VectorRef out) {
  if (model_.traits().linear) {
    if (stiffness_.empty()) {
      stiffness_.resize(model_.pattern().row.size());
      model_.combine({0, 0, 1}, tangent_, stiffness_.data());
    }
    return model_.multiply_matrix(stiffness_.data(), b, out);
  }
  // Two forces cost less than a tangent.
  constexpr double kShare = 1e-5;  // of the size of the motion
  const double largest = b.lpNorm<Eigen::Infinity>();
  if (largest == 0) return out.setZero(), void();
  const Measure measure(statistics_.force);
  const double h = kShare * scales_.position / largest;
  Vector moved = positions(y) + h * b;
  model_.force(t, moved, velocities(y), work_);
  moved = positions(y) - h * b;
  model_.force(t, moved, velocities(y), out);
  out = (out - work_) / (2 * h);
}

int BackwardProblem::products(double t, N_Vector y, N_Vector y_b, N_Vector out) {
  return guarded(callbacks_, [&] {
    const Measure measure(statistics_.sensitivity);
    equations_.products({t, positions(y), velocities(y)}, velocities(y_b), view(out));
  });
}

}  // namespace orthodyn::sundials
