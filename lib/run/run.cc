#include "lib/run/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

class Driver {
 public:
  Driver(const Model& model, Integrator& integrator, const Plan& plan, const std::vector<Observer*>& observers,
         const std::atomic<bool>& interrupt, Outcome& outcome)
      : integrator_(integrator), plan_(plan), observers_(observers), interrupt_(interrupt), outcome_(outcome),
        tiny_(1e-12 * std::max(std::abs(outcome.last.t), std::abs(plan.end))), outputs_(plan.output_times) {
    for (const double t : model.breakpoints(outcome.last.t, plan.end))
      if (t - (stops_.empty() ? outcome.last.t : stops_.back()) > tiny_ && plan.end - t > tiny_) stops_.push_back(t);
    stops_.push_back(plan.end);
    // An output that differs from a stop by round-off is meant to be there.
    for (double& t : outputs_)
      for (const double stop : stops_)
        if (std::abs(t - stop) <= tiny_) t = stop;
    if (plan.delivered) skip_delivered(*plan.delivered);
  }

  void advance() {
    outcome_.between_steps = false;
    for (auto* o : observers_) plan_.delivered ? o->on_resume(outcome_.last) : o->on_start(outcome_.last);
    outcome_.between_steps = true;
    integrator_.start(outcome_.last);
    for (const double stop : stops_) {
      if (!advance_to(stop)) return;
      if (stop < plan_.end) integrator_.start(outcome_.last);  // no step across a kink
    }
  }

 private:
  void skip_delivered(double last) {
    while (next_ < outputs_.size() && outputs_[next_] <= last + tiny_) ++next_;
    // A plan that differs by round-off from the earlier one must not ask for what lies behind.
    for (double& t : outputs_) t = std::max(t, outcome_.last.t);
  }

  // False if interrupted.
  bool advance_to(double stop) {
    while (outcome_.last.t < stop) {
      if (interrupt_) {
        outcome_.status = Outcome::Status::interrupted;
        return false;
      }
      const double limit = plan_.exact_times && next_ < outputs_.size() ? std::min(stop, outputs_[next_]) : stop;
      const StepInfo info = integrator_.step(limit);
      outcome_.between_steps = false;
      while (next_ < outputs_.size() && outputs_[next_] <= info.t) {
        State state;
        integrator_.interpolate(outputs_[next_++], state);
        for (auto* o : observers_) o->on_output(state);
      }
      integrator_.interpolate(info.t, outcome_.last);
      for (auto* o : observers_) o->on_step(info, outcome_.last, integrator_);
      outcome_.between_steps = true;
    }
    return true;
  }

  Integrator& integrator_;
  const Plan& plan_;
  const std::vector<Observer*>& observers_;
  const std::atomic<bool>& interrupt_;
  Outcome& outcome_;
  double tiny_;                          // times closer than this are one
  std::vector<double> outputs_, stops_;
  std::size_t next_ = 0;
};

}  // namespace

double cpu_seconds_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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
  Outcome outcome;
  outcome.last = initial;
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds_now();
  try {
    Driver(model, integrator, plan, observers, interrupt, outcome).advance();
  } catch (const std::bad_alloc&) {
    outcome.status = Outcome::Status::failed;
    outcome.message = "out of memory; use a coarser mesh or another linear solver";
    outcome.reason = Reason::out_of_memory;
  } catch (const ConfigError&) {
    throw;
  } catch (const RunError& e) {
    outcome.status = Outcome::Status::failed;
    outcome.message = e.what();
    outcome.reason = e.reason();
  } catch (const std::exception& e) {
    outcome.status = Outcome::Status::failed;
    outcome.message = e.what();
  }
  for (auto* o : observers) o->on_end();
  outcome.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  outcome.cpu_seconds = cpu_seconds_now() - cpu;
  return outcome;
}

}  // namespace orthodyn
