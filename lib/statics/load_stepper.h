// Follows the equilibria of a body while its loads grow from nothing to all, along the path that they form
// (path_tracer.h): steps are lengthened where Newton's method had little to do, and shortened where it failed.
//
// A critical point, where K becomes singular, is located. At a limit point the load factor is largest and then falls:
// the body snaps through. At a bifurcation the path goes on, and the body leaves it sideways. A change in the number of
// negative eigenvalues of K tells that a critical point was passed; the sign of dlambda/ds tells which of the two it
// is. A body that is not quite straight has no bifurcation: its path turns sharply, close to the path of unstable
// equilibria that the straight body has, onto which a step must not jump.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/spec.h"
#include "lib/ode/integrator.h"
#include "lib/statics/critical_point.h"
#include "lib/statics/path_tracer.h"

namespace orthodyn {

// At a critical point. stop: there. follow: along the path, also where it is unstable. jump: down the energy to a
// stable equilibrium on another path.
enum class AtLimit { stop, follow, jump };

template <>
struct EnumNames<AtLimit> {
  static constexpr std::array<std::pair<AtLimit, const char*>, 3> list{
      {{AtLimit::stop, "stop"}, {AtLimit::follow, "follow"}, {AtLimit::jump, "jump"}}};
};

struct LoadStepping {
  double first_step = 0.25, max_step = 1, min_step = 1e-4;  // of the load factor, where the path begins
  long max_steps = 10'000;
  AtLimit at_limit = AtLimit::stop;

  // These keys, in a Spec of a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

class LoadStepper {
 public:
  // `path` and `solver` must outlive it; length, m: the size of the motion.
  LoadStepper(const LoadPath& path, EquilibriumSolver& solver, const LoadStepping& stepping, double length);

  // The last equilibrium; its t is the load factor.
  const State& state() const { return state_; }
  bool done() const { return state_.t == 1; }
  // That led to it.
  EquilibriumSolver::Attempt attempt() const {
    return tracer_ ? tracer_->place().attempt : EquilibriumSolver::Attempt{};
  }
  // Of the last equilibrium: directions in which it is unstable; none: not known.
  std::optional<int> unstable() const { return tracer_ ? tracer_->place().response.unstable : 0; }
  long rejected() const { return rejected_; }
  long jumps() const { return jumps_; }  // to equilibria that may lie on another path
  long steps() const { return steps_; }
  const std::vector<CriticalPoint>& critical_points() const { return critical_; }

  // To the next equilibrium. Throws RunError with the load factor reached and what to try.
  StepInfo step();

 private:
  using Place = PathTracer::Place;

  void begin();
  void advance();
  bool crosses_critical_point(const Place& next) const;
  bool turns_back(const Place& next) const;
  bool passes_over_too_much(const Place& next) const;
  void pass_critical_point(Place beyond);
  std::optional<Place> close_in(Place beyond);
  CriticalPoint critical_point_before(const Place& beyond) const;
  bool leave();
  bool jump();
  bool branch_off();
  bool move_aside(const Vector& shift);
  bool settle(double load_factor);
  void note_turn(const Place& next);
  void adapt();
  void shorten();
  bool has_moved() const;  // since the last equilibrium that was told
  void arrive();
  void require_going_on() const;
  [[noreturn]] void stop_at(const CriticalPoint& point) const;
  [[noreturn]] void give_up() const;

  const LoadPath& path_;
  EquilibriumSolver& solver_;
  LoadStepping stepping_;
  double length_;
  std::optional<PathTracer> tracer_;
  State state_;
  double step_ = 0, smallest_step_ = 0;  // along the path
  std::vector<CriticalPoint> critical_;
  double steepest_ = 0;      // growth at the last turn
  long iterations_ = 0;      // of the last step
  bool was_halved_ = false;  // after it, as they were many
  bool stops_ = false;       // the last of them is where it stops
  bool leaves_ = false;      // there it is to jump next
  long steps_ = 0, rejected_ = 0, jumps_ = 0;
};

template <class T>
Spec<T> LoadStepping::spec_for() {
  using L = LoadStepping;
  constexpr Range kShare{0, 1, true, false};
  return Spec<T>()
      .key("first_step", &L::first_step, "First step of the load factor, which grows from 0 to 1.", {.range = kShare})
      .key("max_step", &L::max_step, "Its largest step.", {.range = kShare})
      .key("min_step", &L::min_step,
           "Smallest step along the path of equilibria, in load factors at its start: below it the analysis is given "
           "up; at most a 64th of the first step.",
           {.range = kShare})
      .key("max_steps", &L::max_steps, "Load steps after which the analysis is given up.", {.range = {1}})
      .key("at_limit", &L::at_limit,
           "At a limit point (snap-through) or a bifurcation (buckling). stop: there; follow: along the path, past "
           "limit points and through unstable equilibria; jump: to a stable equilibrium on another path.")
      .check([](const T& s, const Config& config) {
        if (s.min_step > s.max_step) config.at("min_step").fail("is larger than max_step");
        if (s.min_step > s.first_step) config.at("min_step").fail("is larger than first_step");
        if (s.first_step > s.max_step) config.at("first_step").fail("is larger than max_step");
      });
}

}  // namespace orthodyn
