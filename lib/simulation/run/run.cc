#include "lib/simulation/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/cause.h"
#include "lib/simulation/run/turn_count.h"

namespace orthodyn {

namespace {

// Ascending times at which something is due.
class DueTimes {
 public:
  explicit DueTimes(std::vector<double> times) : times_(std::move(times)) {}

  // Moves times to one of `others` (ascending) if they differ by less than `tiny`.
  void snap_to(const std::vector<double>& others, double tiny) {
    for (double& t : times_) {
      const auto near = std::lower_bound(others.begin(), others.end(), t - tiny);
      if (near != others.end() && *near <= t + tiny) t = *near;
    }
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  }
  void skip_until(double last, double tiny) {
    while (next_ < times_.size() && times_[next_] <= last + tiny) ++next_;
  }
  // Moves times before t, the time of resuming, to t.
  void begin_at(double t) {
    for (double& time : times_) time = std::max(time, t);
  }

  bool empty() const { return times_.empty(); }
  const std::vector<double>& times() const { return times_; }
  double next() const { return next_ < times_.size() ? times_[next_] : std::numeric_limits<double>::infinity(); }
  // True if a time is due at t. This time is then done, and the next one becomes due.
  bool take_if_due(double t) { return next() == t && ++next_; }

 private:
  std::vector<double> times_;
  std::size_t next_ = 0;
};

class Driver {
 public:
  Driver(const Model& model, Integrator& integrator, const Plan& plan, const std::vector<Observer*>& observers,
         const std::atomic<bool>& interrupt, Outcome& outcome)
      : model_(model),
        integrator_(integrator),
        plan_(plan),
        observers_(observers),
        interrupt_(interrupt),
        outcome_(outcome),
        observed_at_(outcome.last.t),
        tiny_(1e-12 * std::max(std::abs(outcome.last.t), std::abs(plan.end))),
        limits_(model.step_limits(outcome.last.t, plan.end)),
        turns_(model, outcome.last),
        outputs_(plan.output_times),
        history_(plan.history_times) {
    outcome.unresolved_change = limits_.unresolved();
    const double round_off =
        1000 * std::numeric_limits<double>::epsilon() * std::max(std::abs(outcome.last.t), std::abs(plan.end));
    for (const double t : model.breakpoints(outcome.last.t, plan.end))
      if (t - (stops_.empty() ? outcome.last.t : stops_.back()) > round_off && plan.end - t > round_off)
        stops_.push_back(t);
    stops_.push_back(plan.end);
    outputs_.snap_to(stops_, tiny_);
    history_.snap_to(stops_, tiny_);
    history_.snap_to(outputs_.times(), tiny_);
    if (plan.delivered) {
      outputs_.skip_until(*plan.delivered, tiny_);
      history_.skip_until(plan.history_delivered, tiny_);
      outputs_.begin_at(outcome.last.t);
      history_.begin_at(outcome.last.t);
    }
  }

  void advance() {
    try {
      advance_to_end();
    } catch (const RecoverableError& e) {  // of a state that the integrator has accepted
      Cause cause;
      cause.note(e);
      throw RunError(
          cause.explain(fmt::format("the state at t = {:.6g} s cannot be evaluated", observed_at_),
                        integrator_.adaptive() ? "; lower integrator.rtol or integrator.h_max"
                                               : "; lower integrator.step, or use error control (integrator.rtol)"),
          Reason::force);
    }
  }

 private:
  void advance_to_end() {
    outcome_.between_steps = false;
    {
      const Measure measure(outcome_.observation);
      notify_start({model_, outcome_.last});
    }
    outcome_.between_steps = true;
    integrator_.start(outcome_.last);
    for (const double stop : stops_) {
      if (!advance_to(stop)) return;
      if (stop < plan_.end) integrator_.start(outcome_.last);  // restarts, so that no step crosses a kink of a load
    }
  }

  void notify_start(const ObservedState& start) {
    for (auto* o : observers_) plan_.delivered ? o->on_resume(start) : o->on_start(start);
    if (plan_.events && !plan_.delivered) plan_.events->start(start);
  }

  // False if interrupted or stopped by an event.
  bool advance_to(double stop) {
    while (outcome_.last.t < stop) {
      if (model_.space().any(interrupt_)) {
        outcome_.status = Outcome::Status::interrupted;
        return false;
      }
      const double begin = outcome_.last.t, seen_until = limits_.latest_end(begin);
      double limit = stop;
      if (plan_.exact_times || !integrator_.has_accurate_interpolation()) limit = std::min(limit, outputs_.next());
      if (!integrator_.has_accurate_interpolation()) limit = std::min(limit, history_.next());
      if (integrator_.adaptive()) limit = std::min(limit, seen_until);
      const double unseen = model_.longest_step(outcome_.last);
      const double due = limit;
      if (integrator_.adaptive() && std::isfinite(unseen))
        limit = std::min(limit, begin + std::min(unseen, kGrowth * last_step_));
      StepInfo info = integrator_.step(limit);
      const bool cut_by_output = info.t >= due && info.h < last_step_ && std::isfinite(last_step_);
      if (!cut_by_output) last_step_ = info.h;
      if (!outcome_.may_pass_through && info.h > kMissed * unseen) outcome_.may_pass_through = begin;
      if (!outcome_.stepped_over && info.t > seen_until + kLongStep * (seen_until - begin))
        outcome_.stepped_over = begin;
      outcome_.between_steps = false;
      const Measure measure(outcome_.observation);
      observed_at_ = info.t;
      count_turns(info.t);
      const Event* stopper = deliver_events(begin, info);
      deliver_outputs(info.t);
      if (stopper) deliver_last_output(info.t);
      observed_at_ = info.t;
      interpolate(info.t, outcome_.last);
      const ObservedState end(model_, outcome_.last);
      if (plan_.history_at_steps) notify_history(end);
      for (auto* o : observers_) o->on_step(info, end, integrator_);
      outcome_.between_steps = true;
      if (stopper) {
        outcome_.remark = fmt::format("stopped by the event '{}' at t = {:.9g} s", stopper->name, info.t);
        return false;
      }
    }
    return true;
  }

  void count_turns(double end) {
    if (turns_.empty()) return;
    State state;
    integrator_.interpolate(end, state);
    turns_.advance(state);
  }

  void interpolate(double t, State& out) const {
    integrator_.interpolate(t, out);
    if (!turns_.empty()) out.angles = turns_.at(t);
  }

  // Returns the event that stops the run, if any; the step then ends at the event.
  const Event* deliver_events(double begin, StepInfo& info) {
    if (!plan_.events || plan_.events->empty()) return nullptr;
    const double end = info.t, h = end - begin, parts = smooth_parts(integrator_, h);
    const auto at = [this](double t, State& out) { interpolate(t, out); };
    for (double part = 0; part < parts; ++part) {
      const double to = part + 1 < parts ? begin + (part + 1) * h / parts : end;
      for (const Crossing& crossing : plan_.events->find(begin + part * h / parts, to, model_, at)) {
        deliver_outputs(crossing.state.t);
        for (auto* o : observers_) o->on_event(crossing);
        if (!crossing.event->stops) continue;
        info.t = crossing.state.t;
        info.h = info.t - begin;
        return crossing.event;
      }
    }
    return nullptr;
  }

  void deliver_outputs(double until) {
    for (;;) {
      const double t = std::min(outputs_.next(), history_.next());
      if (t > until) return;
      const bool is_output = outputs_.take_if_due(t), is_history = history_.take_if_due(t);
      deliver(t, is_output, is_history || (is_output && history_follows_outputs()));
    }
  }

  bool history_follows_outputs() const { return history_.empty() && !plan_.history_at_steps; }

  void deliver(double t, bool is_output, bool is_history) {
    State state;
    observed_at_ = t;
    interpolate(t, state);
    const ObservedState observed(model_, state);
    if (is_history) notify_history(observed);  // first: on_output may throw (LinearityWatch)
    if (!is_output) return;
    for (auto* o : observers_) o->on_output(observed);
    last_output_ = t;
  }

  void notify_history(const ObservedState& observed) {
    for (auto* o : observers_) o->on_history(observed);
    last_history_ = observed.t();
  }

  // Delivers output and history at t, the end of the run, if the plan has any and this has not yet been done.
  void deliver_last_output(double t) {
    const bool is_output = !outputs_.empty() && last_output_ != t;
    const bool is_history = history_follows_outputs() ? is_output : !history_.empty() && last_history_ != t;
    if (is_output || is_history) deliver(t, is_output, is_history);
  }

  const Model& model_;
  Integrator& integrator_;
  const Plan& plan_;
  const std::vector<Observer*>& observers_;
  const std::atomic<bool>& interrupt_;
  Outcome& outcome_;
  static constexpr double kLongStep = 3;
  // At the end of a step, libraries shorten the next one to the rest of the way to this limit: by four, steps may grow
  // to three times the last one. A body under a constant force is then at most four times as fast after a step.
  static constexpr double kGrowth = 4;
  static constexpr double kMissed = 4;  // fixed steps that are longer than Model::longest_step() by this are told

  double last_step_ = std::numeric_limits<double>::infinity();  // s
  double observed_at_;                                          // s, the state that observers see
  double tiny_;  // outputs closer than this to a stop are moved to the stop, s
  StepLimits limits_;
  TurnCount turns_;
  std::vector<double> stops_;
  DueTimes outputs_, history_;
  std::optional<double> last_output_, last_history_;
};

}  // namespace

std::vector<double> evenly_spaced(double start, double end, int frames) {
  std::vector<double> times;
  for (int k = 1; k <= frames; ++k) times.push_back((start * (frames - k) + end * k) / frames);
  return times;
}

std::vector<double> by_interval(double start, double end, double interval) {
  std::vector<double> times;
  // At late times round-off may exceed 1e-9 of the interval.
  const double round_off = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(start), std::abs(end));
  const double same = std::max(1e-9 * interval, round_off);
  for (long k = 1;; ++k) {
    const double t = start + static_cast<double>(k) * interval;
    if (t > end - same) break;
    times.push_back(t);
  }
  times.push_back(end);
  return times;
}

Outcome run(const Model& model, Integrator& integrator, const State& initial, const Plan& plan,
            const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt) {
  return supervise(initial, observers,
                   [&](Outcome& outcome) { Driver(model, integrator, plan, observers, interrupt, outcome).advance(); });
}

}  // namespace orthodyn
