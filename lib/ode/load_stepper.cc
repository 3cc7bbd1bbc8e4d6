#include "lib/ode/load_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {
constexpr long kEasy = 6, kHard = 12;  // Newton iterations
}

LoadStepper::LoadStepper(const LoadPath& path, EquilibriumSolver& solver, const LoadStepping& stepping)
    : path_(path), solver_(solver), stepping_(stepping),
      state_{0, path.start(), Vector::Zero(path.num_dofs())}, step_(stepping.first_step) {}

StepInfo LoadStepper::step() {
  if (steps_ >= stepping_.max_steps)
    throw RunError(fmt::format("gave up at load factor {:.6g} after {} steps (statics.max_steps); raise it, or "
                               "statics.max_step",
                               state_.t, steps_),
                   Reason::too_many_steps);
  const double from = state_.t;
  while (!try_to_reach(target(), EquilibriumSolver::Where::nearby)) {
    ++rejected_;
    if (step_ > stepping_.min_step) cut_back();
    else if (stepping_.may_jump && jump()) break;
    else give_up();
  }
  ++steps_;
  adapt();
  return {state_.t, state_.t - from, 1};
}

// No sliver of a step is left over for the end.
double LoadStepper::target() const {
  const double next = state_.t + step_;
  return next > 1 - 0.5 * stepping_.min_step ? 1 : next;
}

bool LoadStepper::try_to_reach(double target, EquilibriumSolver::Where where) {
  Vector q = state_.q;
  attempt_ = solver_.solve(target, q, where);
  if (!attempt_.found) return false;
  state_.t = target;
  state_.q = std::move(q);
  return true;
}

void LoadStepper::adapt() {
  if (attempt_.iterations <= kEasy) step_ = std::min(2 * step_, stepping_.max_step);
  else if (attempt_.iterations > kHard) step_ = std::max(step_ / 2, stepping_.min_step);
}

void LoadStepper::cut_back() { step_ = std::max(std::min(step_, 1 - state_.t) / 2, stepping_.min_step); }

// A step far enough that what is out of balance drives the body away from the limit point.
bool LoadStepper::jump() {
  const auto nearby = attempt_;
  const double cut_back_to = std::exchange(step_, stepping_.first_step);
  if (!try_to_reach(target(), EquilibriumSolver::Where::anywhere)) {
    attempt_ = nearby;
    step_ = cut_back_to;
    return false;
  }
  ++jumps_;
  return true;
}

void LoadStepper::give_up() const {
  if (attempt_.indefinite)
    throw RunError(
        fmt::format(
            "the branch of stable equilibria ends at load factor {:.6g}, the last one found on it, to within {:.2g} "
            "(statics.min_step): beyond it {}, as where a body snaps through or buckles. What follows "
            "is a motion (analysis: dynamic); {}",
            state_.t, stepping_.min_step, attempt_.failure_reason,
            stepping_.may_jump ? "no equilibrium was found elsewhere either (statics.at_limit: jump)"
                               : "statics.at_limit: jump looks for an equilibrium elsewhere"),
        Reason::newton);
  throw RunError(
      fmt::format("no equilibrium was found beyond load factor {:.6g}, with steps down to {:.2g} "
                  "(statics.min_step): {}. Lower statics.min_step or the loads, or let the body come to rest in "
                  "time with damping (analysis: dynamic)",
                  state_.t, stepping_.min_step, attempt_.failure_reason),
      Reason::newton);
}

}  // namespace orthodyn
