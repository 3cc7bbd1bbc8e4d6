// Follows the equilibrium of a body while its loads grow from nothing to all: steps in the load factor that
// are halved where no equilibrium is found and doubled where it was easy.
//
// Each step has to lead to an equilibrium nearby (equilibrium.h), with a positive definite stiffness on the way: where
// that fails for the smallest step the branch of stable equilibria ends (limit point, bifurcation), which is thus found
// to within that step. Only then, and only if a jump is allowed, it searches for an equilibrium on any branch.
#pragma once

#include "lib/config/spec.h"
#include "lib/ode/equilibrium.h"
#include "lib/ode/integrator.h"
#include "lib/ode/load_path.h"

namespace orthodyn {

struct LoadStepping {
  double first_step = 0.25, max_step = 1, min_step = 1e-4;  // of the load factor
  long max_steps = 10'000;
  bool may_jump = false;

  // These keys, in a Spec of a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

class LoadStepper {
 public:
  // `path` and `solver` must outlive it.
  LoadStepper(const LoadPath& path, EquilibriumSolver& solver, const LoadStepping& stepping);

  // The last equilibrium; its t is the load factor.
  const State& state() const { return state_; }
  bool done() const { return state_.t >= 1; }
  // Of the last step.
  const EquilibriumSolver::Attempt& attempt() const { return attempt_; }
  long rejected() const { return rejected_; }
  long jumps() const { return jumps_; }  // to equilibria that may lie on another branch
  long steps() const { return steps_; }

  // To the next equilibrium. Throws RunError with the load factor reached and what to try.
  StepInfo step();

 private:
  double target() const;
  bool try_to_reach(double target, EquilibriumSolver::Where where);
  void adapt();
  void cut_back();
  bool jump();
  [[noreturn]] void give_up() const;

  const LoadPath& path_;
  EquilibriumSolver& solver_;
  LoadStepping stepping_;
  State state_;
  EquilibriumSolver::Attempt attempt_;
  double step_;
  long steps_ = 0, rejected_ = 0, jumps_ = 0;
};

template <class T>
Spec<T> LoadStepping::spec_for() {
  using L = LoadStepping;
  constexpr Range kShare{0, 1, true, false};
  return Spec<T>()
      .key("first_step", &L::first_step, "First step of the load factor, which grows from 0 to 1.", {.range = kShare})
      .key("max_step", &L::max_step, "Its largest step.", {.range = kShare})
      .key("min_step", &L::min_step, "Its smallest step: how closely the end of a branch is found.", {.range = kShare})
      .key("max_steps", &L::max_steps, "Load steps after which the analysis is given up.", {.range = {1}})
      .check([](const T& s, const Config& config) {
        if (s.min_step > s.max_step) config.at("min_step").fail("is larger than max_step");
        if (s.min_step > s.first_step) config.at("min_step").fail("is larger than first_step");
        if (s.first_step > s.max_step) config.at("first_step").fail("is larger than max_step");
      });
}

}  // namespace orthodyn
