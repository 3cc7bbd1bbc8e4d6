// Base class of the integrators that call SUNDIALS, with the state y = (q, v, z); z are the internal variables of the
// model (lib/ode/internal_variables.h), which most models lack; IDA adds multipliers of constraints. It contains what
// CVODE, IDA and ARKODE share: state, error weights, Newton's linear systems, counters and failure messages. One
// derived class per library makes the calls that differ.
//
// Error test: the local error e of y is accepted if the root mean square of w_i e_i is at most 1. The inverse weight
// 1/w_i is rtol times the position scale for positions and rtol times the velocity scale for velocities. Tolerances
// relative to the positions themselves would depend on the frame of reference. For internal variables, 1/w_i is rtol
// times the largest root mean square of z so far, and the mean of their squares is added to that of positions and
// velocities.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "integrators/renewal_policy.h"
#include "integrators/sundials/newton_system.h"
#include "integrators/sundials/nonsmooth_newton.h"
#include "lib/ode/constraints.h"
#include "lib/ode/internal_model.h"

namespace orthodyn::sundials {

// Functions with the same signature and meaning in CVODE, IDA and ARKODE.
struct LibraryCalls {
  int (*set_user_data)(void* memory, void* user);
  int (*set_error_weights)(void* memory, int (*)(N_Vector y, N_Vector weights, void* user));
  int (*set_initial_step)(void* memory, sunrealtype h);
  int (*set_max_step)(void* memory, sunrealtype h);
  int (*set_min_step)(void* memory, sunrealtype h);
  int (*set_nonlinear_solver)(void* memory, SUNNonlinearSolver solver);
  int (*set_linear_solver)(void* memory, SUNLinearSolver solver, SUNMatrix matrix);
  int (*last_step)(void* memory, sunrealtype* h);
  int (*current_step)(void* memory, sunrealtype* h);
  int (*steps)(void* memory, long* count);
  int (*error_test_failures)(void* memory, long* count);
  int (*convergence_failures)(void* memory, long* count);
  int (*newton_iterations)(void* memory, long* count);
  int (*workspace)(void* memory, long* reals, long* integers);
  // Largest number of steps between two factorisations and between two tangents; 0: the library's default, 20 and 51.
  // Null in IDA.
  int (*set_factor_interval)(void* memory, long steps) = nullptr;
  int (*set_tangent_interval)(void* memory, long steps) = nullptr;
  bool algebraic = false;  // solves algebraic equations: multipliers of constraints are unknowns. True in IDA
};

// The LibraryCalls of CVODE, IDA or ARKODE from the prefix of its functions, CVode, IDA or ARKStep. Calls that IDA
// lacks stay null.
#define ORTHODYN_LIBRARY_CALLS(prefix)                                                                               \
  {                                                                                                                  \
    .set_user_data = prefix##SetUserData, .set_error_weights = prefix##WFtolerances,                                 \
    .set_initial_step = prefix##SetInitStep, .set_max_step = prefix##SetMaxStep, .set_min_step = prefix##SetMinStep, \
    .set_nonlinear_solver = prefix##SetNonlinearSolver, .set_linear_solver = prefix##SetLinearSolver,                \
    .last_step = prefix##GetLastStep, .current_step = prefix##GetCurrentStep, .steps = prefix##GetNumSteps,          \
    .error_test_failures = prefix##GetNumErrTestFails, .convergence_failures = prefix##GetNumStepSolveFails,         \
    .newton_iterations = prefix##GetNumNonlinSolvIters, .workspace = prefix##GetWorkSpace                            \
  }

class SundialsIntegrator : public Integrator {
 public:
  void start(const State& state) override;
  StepInfo step(double t_stop) override;
  void interpolate(double t, State& out) const override;
  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override { return newton_system_ ? newton_system_->factor_bytes() : 0; }
  std::size_t bytes() const override;
  Decisions decisions() const override;

 protected:
  // `name`: the integrator's type, for messages. `implicit`: true if Newton's method solves the equations of a step.
  // Throws ConfigError if the linear solver does not accept the model's matrices.
  SundialsIntegrator(std::string name, const LibraryCalls& library, const Model& model, const Options& options,
                     const Scales& scales, bool implicit);

  // For integrators of y' = (v, M^-1 f): throws ConfigError for klu_full with a consistent mass, whose inverse is
  // dense.
  void check_mass_for_full_jacobian() const;

  virtual void* memory() const = 0;  // memory block of the library
  // Start the library at time t (s) and state y(): initialise() at the first start, reinitialise() at later ones.
  virtual void initialise(double t) = 0;
  virtual void reinitialise(double t) = 0;
  // Makes the library take one step, which ends at t_stop at the latest. Updates y() and t; returns the library's flag.
  virtual int advance(double t_stop, double& t) = 0;
  virtual int last_order() const = 0;
  // Computes (q, v) at a time within the last step; returns the library's flag.
  virtual int dense_output(double t, N_Vector out) const = 0;
  virtual Reason classify(int flag) const = 0;  // reason for a negative flag
  // Number of steps that the derived class has repeated; the library does not count these as convergence failures.
  virtual long retries() const { return 0; }
  virtual std::size_t own_bytes() const { return 0; }  // bytes of the derived class itself
  // Message for a step whose iteration does not converge, with the remedy.
  virtual std::string iteration_failure() const;

  // Called by initialise() of derived classes. The user data of callbacks is a SundialsIntegrator*.
  void set_error_weights();
  void set_step_limits();
  void use_nonsmooth_newton();
  // Passes the Newton system to the library after its creation.
  void attach_linear_solver();
  // Calls `attempt`, which takes one step with the library, and makes the library renew Newton's matrix first if this
  // is due (renewal_policy.h). Returns the flag of `attempt`.
  int step_with_matrix_renewal(const std::function<int()>& attempt);
  // Derived classes call this when they restart the library, which then renews the matrix.
  void restart_renewal();
  // Throws RunError with the library's message if the flag is negative.
  void require(int flag) const;
  // Throws RunError with position, reason and remedy if the flag, of a call that takes steps, is negative.
  void finish(int flag) {
    if (flag < 0) fail(flag);
  }

  double current_step() const;  // length of the step being tried, s
  // "problem (why the model refused the last state)advice": Cause::explain().
  std::string explained(const std::string& problem, const std::string& advice) const;

  // Computes a = M^-1 f (m/s^2) at (t, y). For use in callbacks: returns 0, +1 (recoverable) or -1 (fatal), throws
  // nothing.
  int evaluate_acceleration(const Model& model, double t, N_Vector y, VectorRef a);
  // Computes a = M^-1 f (m/s^2) at the initial state y(). Throws RunError if the force cannot be evaluated.
  void initial_acceleration(const Model& model, double t, VectorRef a);

  // Sets the rates (e - z) / tau of the internal variables in y_dot, if the model has any. As evaluate_acceleration().
  int evaluate_internal_rates(double t, N_Vector y, N_Vector y_dot);

  Extra extra() const { return extra_; }
  Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(model_.num_dofs()) + extra().size(); }
  // The model with the internal variables of y; `model` itself if it has none.
  const Model& with_internals(const Model& model, N_Vector y);
  N_Vector y() const { return y_.get(); }

  const Model& model_;
  const Options options_;
  const Scales scales_;
  Decisions decisions_;  // values chosen for keys that the input left open, except linear_solver
  Statistics statistics_;
  CallbackContext callback_context_;
  std::optional<GivenInternalModel> internal_;  // only for models with internal variables
  const Extra extra_;                           // numbers of further unknowns
  Context context_;                             // declared before everything created in it
  OwnedVector y_;
  std::optional<NonsmoothNewton> nonsmooth_newton_;
  std::optional<NewtonSystem> newton_system_;  // only if implicit

 private:
  // Counts of the library since it was (re-)initialised.
  struct Counters {
    long steps = 0, error_test_failures = 0, convergence_failures = 0, newton_iterations = 0;
    void add(const Counters& other);
  };
  Counters counters() const;
  void update_statistics();
  // Throws RunError if the last step was so short that round-off of the time t is comparable to the step.
  void refuse_tiny_steps(const StepInfo& info, double t_stop) const;
  std::string position() const;  // "NAME stopped at t = ..., step ...: "
  [[noreturn]] void fail(int flag);

  std::string name_;
  const LibraryCalls& library_;
  std::optional<RenewalPolicy> renewal_;  // only with Newton's method, and not in IDA
  Counters before_;                       // sums until the last restart of the library
  double t_ = 0;
  bool started_ = false;
  double largest_strain_ = 0;  // unit of the error of internal variables

  void set_weights(N_Vector y, N_Vector weights);
};

}  // namespace orthodyn::sundials
