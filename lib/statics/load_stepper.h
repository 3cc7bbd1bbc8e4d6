// Load stepping: follows the path of equilibria (path_tracer.h) from load factor 0 to 1. The step grows after few
// Newton iterations and shrinks after many or after failures.
//
// Critical points, at which K is singular, are detected by a change in the number of negative eigenvalues of K or in
// the sign of dlambda/ds (s: arc length), and then located. At a limit point the load factor is largest and then
// decreases: the body snaps through. At a bifurcation the path continues, but the body buckles away from it. The path
// of an imperfect body turns sharply instead, close to the unstable path of the perfect body. Steps must not jump to
// that unstable path.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "lib/config/spec.h"
#include "lib/ode/integrator.h"
#include "lib/statics/critical_point.h"
#include "lib/statics/path_tracer.h"

namespace orthodyn {

// What to do at a critical point. stop: end the analysis. follow: continue along the path, through unstable equilibria.
// jump: go to a stable equilibrium elsewhere, along another branch or by minimising the energy.
enum class AtLimit { stop, follow, jump };

template <>
struct EnumNames<AtLimit> {
  static constexpr std::array<std::pair<AtLimit, const char*>, 3> list{
      {{AtLimit::stop, "stop"}, {AtLimit::follow, "follow"}, {AtLimit::jump, "jump"}}};
};

struct LoadStepping {
  double first_step = 0.25, max_step = 1, min_step = 1e-4;  // of the load factor; min_step: at the start of the path
  long max_steps = 10'000;
  AtLimit at_limit = AtLimit::stop;

  // Spec with these keys for a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

class LoadStepper {
 public:
  // `path` and `solver` must outlive this object. `length` (m, > 0): bound of a nonlinear body's first displacement,
  // and scale of jumps.
  LoadStepper(const LoadPath& path, EquilibriumSolver& solver, const LoadStepping& stepping, double length);

  // The last equilibrium; state().t is the load factor.
  const State& state() const { return state_; }
  bool done() const { return state_.t == 1; }
  // The attempt that found the last equilibrium.
  EquilibriumSolver::Attempt attempt() const {
    return tracer_ ? tracer_->current().attempt : EquilibriumSolver::Attempt{};
  }
  // Number of directions in which the last equilibrium is unstable; empty if unknown.
  std::optional<int> unstable() const { return tracer_ ? tracer_->current().response.unstable : 0; }
  long rejected() const { return rejected_; }
  long jumps() const { return jumps_; }  // jumps to equilibria that may lie on another path
  long steps() const { return steps_; }
  const std::vector<CriticalPoint>& critical_points() const { return critical_; }

  // Advances to the next equilibrium. Throws RunError with the load factor reached and a remedy.
  StepInfo step();

 private:
  using PathState = PathTracer::PathState;

  void begin();
  void advance();
  bool crosses_critical_point(const PathState& next) const;
  bool turns_back(const PathState& next) const;
  bool exceeds_max_step(const PathState& next) const;
  bool may_pass_through(const PathState& next) const;
  void pass_critical_point(PathState beyond);
  std::optional<PathState> locate_critical_point(PathState beyond);
  CriticalPoint critical_point_before(const PathState& beyond) const;
  void jump_or_stop();
  bool jump();
  bool branch_off();
  bool move_to_branch(const Vector& shift);
  bool descend_to_equilibrium(double load_factor);
  void record_sharp_turn(const PathState& next);
  void adapt_step();
  bool has_advanced() const;  // true if the tracer is no longer at state()
  void update_state();
  void check_limits() const;
  [[noreturn]] void stop_at(const CriticalPoint& point) const;
  [[noreturn]] void give_up() const;

  const LoadPath& path_;
  EquilibriumSolver& solver_;
  LoadStepping stepping_;
  double length_;
  std::optional<PathTracer> tracer_;
  State state_;
  double step_ = 0, smallest_step_ = 0;  // arc lengths
  std::vector<CriticalPoint> critical_;
  double steepest_ = 0;          // PathTracer::growth() at the last sharp turn
  long iterations_ = 0;          // Newton iterations of the last step
  bool passes_through_ = false;  // the last attempt was rejected because bodies may pass through each other
  bool was_halved_ = false;      // the step was halved after the last step
  bool stops_next_ = false;      // the next step() stops at the last critical point
  bool jumps_next_ = false;      // the next step() jumps from the last critical point
  long steps_ = 0, rejected_ = 0, jumps_ = 0;
};

template <class T>
Spec<T> LoadStepping::spec_for() {
  using L = LoadStepping;
  constexpr Range kShare{0, 1, true, false};
  return Spec<T>()
      .key("first_step", &L::first_step, "First step of the load factor, which grows from 0 to 1.", {.range = kShare})
      .key("max_step", &L::max_step, "Largest step of the load factor.", {.range = kShare})
      .key("min_step", &L::min_step,
           "Smallest step: the arc length along the path of equilibria that this change of the load factor has at the "
           "start of the path, at most a 64th of the first step. The analysis stops if it needs a smaller step.",
           {.range = kShare})
      .key("max_steps", &L::max_steps, "Number of load steps after which the analysis stops.", {.range = {1}})
      .key("at_limit", &L::at_limit,
           "What to do at a limit point (snap-through) or a bifurcation (buckling). stop: end the analysis; follow: "
           "continue along the path, past limit points and through unstable equilibria; jump: go to a stable "
           "equilibrium on another path.")
      .check([](const T& s, const Config& config) {
        if (s.min_step > s.max_step) config.at("min_step").fail("is larger than max_step");
        if (s.min_step > s.first_step) config.at("min_step").fail("is larger than first_step");
        if (s.first_step > s.max_step) config.at("first_step").fail("is larger than max_step");
      });
}

}  // namespace orthodyn
