// What all integrators of SUNDIALS share: the state, the callbacks into the model, the linear solver
// (reduced or full), counting, and the messages of failure. The calls of each library stay in its own integrators.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "integrators/reduced_solve.h"
#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/full_jacobian.h"
#include "integrators/sundials/solver_adapter.h"
#include "integrators/sundials/sundials_options.h"

namespace orthodyn::sundials {

class SundialsIntegrator : public Integrator {
 public:
  void start(const State& state) override;
  StepInfo step(double t_stop) override;
  void interpolate(double t, State& out) const override;
  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override {
    return reduced_ ? reduced_->factor_bytes() : klu_factor_bytes(klu_.get());
  }
  std::size_t bytes() const override;
  Decisions decisions() const override;

 protected:
  // What the library has counted since it was (re-)initialised.
  struct Counters {
    long steps = 0, error_test_failures = 0, convergence_failures = 0, newton_iterations = 0;
  };
  // `name` is the integrator's, for messages.
  SundialsIntegrator(std::string name, const Model& model, const Settings& settings);

  // The first start and further ones, from y(); the first may set up more.
  virtual void initialise(double t) = 0;
  virtual void reinitialise(double t) = 0;
  // One step of the library from y() to y(), at t_stop at the latest: sets t and returns the library's flag.
  virtual int advance(double t_stop, double& t) = 0;
  virtual StepInfo last_step() const = 0;
  virtual double current_step() const = 0;  // s, of the step that is being tried
  // (q, v) at a time within the last step; returns the library's flag.
  virtual int dense_output(double t, N_Vector out) const = 0;
  virtual Counters counters() const = 0;
  virtual Reason classify(int flag) const = 0;  // of a negative flag
  virtual std::size_t workspace_bytes() const = 0;
  // What to say when the iteration of a step does not converge, and the remedy.
  virtual std::string iteration_failure() const;
  std::string cause() const;  // why the model refused the last state, if it did

  // Throws RunError with the library's words if the flag is negative.
  void require(int flag) const;

  // a = M^-1 f at y(), m/s^2, where the integration begins. Throws RunError where it cannot be evaluated.
  void initial_acceleration(const Model& model, double t, VectorRef a);

  // The linear solver: its calls go to the reduced solve, or to SUNDIALS' KLU.
  void make_reduced_solver(std::function<double()> gamma, std::function<void(N_Vector x, N_Vector b)> solve);
  void make_full_solver();
  void linearize_full(double t, N_Vector y);

  Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(model_.num_dofs()); }
  N_Vector y() const { return y_.get(); }

  const Model& model_;
  Settings settings_;
  Statistics statistics_;
  CallbackContext callback_context_;
  Context context_;  // before everything made in it
  OwnedVector y_;
  Vector momentum_;
  std::optional<ReducedSolve> reduced_;
  std::optional<FullJacobian> full_;
  Linearization linearization_;  // of the full path
  SolverFunctions functions_;    // before the adapter that calls them
  OwnedMatrix matrix_;
  OwnedSolver klu_, solver_;  // SUNDIALS' KLU of the full path is called by the adapter

 private:
  void update_statistics();
  void refuse_tiny_steps(const StepInfo& info, double t_stop) const;
  std::string position() const;  // where it stopped, to begin a message
  [[noreturn]] void fail(int flag);

  std::string name_;
  Counters before_;  // counted before the last restart
  double t_ = 0;
  bool started_ = false;
};

}  // namespace orthodyn::sundials
