#include "lib/simulation/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthodyn {

namespace {

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
        tiny_(1e-12 * std::max(std::abs(outcome.last.t), std::abs(plan.end))),
        limits_(model.step_limits(outcome.last.t, plan.end)),
        outputs_(plan.output_times) {
    outcome.unresolved = limits_.unresolved();
    const double round_off =
        1000 * std::numeric_limits<double>::epsilon() * std::max(std::abs(outcome.last.t), std::abs(plan.end));
    for (const double t : model.breakpoints(outcome.last.t, plan.end))
      if (t - (stops_.empty() ? outcome.last.t : stops_.back()) > round_off && plan.end - t > round_off)
        stops_.push_back(t);
    stops_.push_back(plan.end);
    // An output that differs from a stop by round-off is meant to be there.
    for (double& t : outputs_)
      for (const double stop : stops_)
        if (std::abs(t - stop) <= tiny_) t = stop;
    if (plan.delivered) skip_delivered(*plan.delivered);
  }

  void advance() {
    outcome_.between_steps = false;
    tell_of_start({model_, outcome_.last});
    outcome_.between_steps = true;
    integrator_.start(outcome_.last);
    for (const double stop : stops_) {
      if (!advance_to(stop)) return;
      if (stop < plan_.end) integrator_.start(outcome_.last);  // no step across a kink
    }
  }

 private:
  void tell_of_start(const ObservedState& start) {
    for (auto* o : observers_) plan_.delivered ? o->on_resume(start) : o->on_start(start);
    if (plan_.events && !plan_.delivered) plan_.events->start(start);
  }

  void skip_delivered(double last) {
    while (next_ < outputs_.size() && outputs_[next_] <= last + tiny_) ++next_;
    // A plan that differs by round-off from the earlier one must not ask for what lies behind.
    for (double& t : outputs_) t = std::max(t, outcome_.last.t);
  }

  // False if interrupted or stopped by an event.
  bool advance_to(double stop) {
    while (outcome_.last.t < stop) {
      if (interrupt_) {
        outcome_.status = Outcome::Status::interrupted;
        return false;
      }
      const bool exact = plan_.exact_times || !integrator_.has_accurate_interpolation();
      const double begin = outcome_.last.t, seen_until = limits_.latest_end(begin);
      double limit = exact && next_ < outputs_.size() ? std::min(stop, outputs_[next_]) : stop;
      if (integrator_.adaptive()) limit = std::min(limit, seen_until);
      StepInfo info = integrator_.step(limit);
      if (!outcome_.stepped_over && info.t > seen_until + kMuchLonger * (seen_until - begin))
        outcome_.stepped_over = begin;
      outcome_.between_steps = false;
      const Event* stopper = deliver_events(begin, info);
      deliver_outputs(info.t);
      if (stopper) deliver_last_output(info.t);
      integrator_.interpolate(info.t, outcome_.last);
      const ObservedState end(model_, outcome_.last);
      for (auto* o : observers_) o->on_step(info, end, integrator_);
      outcome_.between_steps = true;
      if (stopper) {
        outcome_.remark = fmt::format("stopped by the event '{}' at t = {:.9g} s", stopper->name, info.t);
        return false;
      }
    }
    return true;
  }

  // The event that stops the run, if any: the step then is taken to end there.
  const Event* deliver_events(double begin, StepInfo& info) {
    if (!plan_.events || plan_.events->empty()) return nullptr;
    const auto interpolate = [&](double t, State& out) { integrator_.interpolate(t, out); };
    const double end = info.t, h = end - begin, parts = smooth_parts(integrator_, h);
    for (double part = 0; part < parts; ++part) {
      const double to = part + 1 < parts ? begin + (part + 1) * h / parts : end;
      for (const Crossing& crossing : plan_.events->find(begin + part * h / parts, to, model_, interpolate)) {
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
    while (next_ < outputs_.size() && outputs_[next_] <= until) deliver_output(outputs_[next_++]);
  }

  void deliver_output(double t) {
    State state;
    integrator_.interpolate(t, state);
    const ObservedState output(model_, state);
    for (auto* o : observers_) o->on_output(output);
    last_output_ = t;
  }

  // Where outputs are wanted at all, there is one at the end.
  void deliver_last_output(double t) {
    if (!outputs_.empty() && last_output_ != t) deliver_output(t);
  }

  const Model& model_;
  Integrator& integrator_;
  const Plan& plan_;
  const std::vector<Observer*>& observers_;
  const std::atomic<bool>& interrupt_;
  Outcome& outcome_;
  static constexpr double kMuchLonger = 3;

  double tiny_;                          // outputs that are closer to a stop than this are meant to be there
  StepLimits limits_;
  std::vector<double> outputs_, stops_;
  std::optional<double> last_output_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<double> evenly_spaced(double start, double end, int frames) {
  std::vector<double> times;
  for (int k = 1; k <= frames; ++k) times.push_back((start * (frames - k) + end * k) / frames);
  return times;
}

std::vector<double> by_interval(double start, double end, double interval) {
  std::vector<double> times;
  for (long k = 1;; ++k) {
    const double t = start + static_cast<double>(k) * interval;
    if (t > end - 1e-9 * interval) break;
    times.push_back(t);
  }
  times.push_back(end);
  return times;
}

Outcome run(const Model& model, Integrator& integrator, const State& initial, const Plan& plan,
            const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt) {
  return supervise(initial, observers, [&](Outcome& outcome) {
    Driver(model, integrator, plan, observers, interrupt, outcome).advance();
  });
}

}  // namespace orthodyn
