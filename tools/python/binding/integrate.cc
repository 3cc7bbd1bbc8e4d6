#include "tools/python/binding/integrate.h"

#include <atomic>
#include <chrono>
#include <exception>

#include "lib/config/config.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/run/run.h"
#include "tools/python/binding/arrays.h"

namespace orthodyn::python {

namespace {

class Trajectory : public Observer {
 public:
  explicit Trajectory(std::atomic<bool>& interrupt) : interrupt_(interrupt) {}

  void on_start(const ObservedState& observed) override { record(observed); }
  void on_output(const ObservedState& observed) override { record(observed); }
  void on_step(const StepInfo&, const ObservedState&, const Integrator&) override {
    if (PyErr_CheckSignals() == 0) return;
    interrupt_ = true;
    interrupted_by_ = std::make_exception_ptr(py::error_already_set());
  }

  void rethrow() const {
    if (interrupted_by_) std::rethrow_exception(interrupted_by_);
  }
  void write(py::dict& out, py::ssize_t n) {
    const auto count = static_cast<py::ssize_t>(t_.size());
    out["t"] = array_of(std::move(t_));
    out["q"] = array_of(std::move(q_), {count, n});
    out["v"] = array_of(std::move(v_), {count, n});
  }

 private:
  void record(const ObservedState& observed) {
    const State& state = observed.state();
    t_.push_back(state.t);
    q_.insert(q_.end(), state.q.data(), state.q.data() + state.q.size());
    v_.insert(v_.end(), state.v.data(), state.v.data() + state.v.size());
  }

  std::atomic<bool>& interrupt_;
  std::exception_ptr interrupted_by_;
  std::vector<double> t_, q_, v_;
};

py::dict statistics_of(const Statistics& s) {
  py::dict out;
  out["steps"] = s.steps;
  out["rejected_steps"] = s.rejected_steps;
  out["newton_iterations"] = s.newton_iterations;
  const auto cost = [&](const char* name, const Cost& c) {
    out[name] = py::dict(py::arg("count") = c.count, py::arg("seconds") = c.seconds);
  };
  cost("force", s.force);
  cost("tangent", s.tangent);
  cost("factorization", s.factorization);
  cost("solve", s.solve);
  return out;
}

// Rethrows exceptions of the model's functions with their own type, also if `auto` has called the functions.
std::unique_ptr<Integrator> make_integrator(const IntegratorChoice& choice, const PythonModel& model,
                                            const Task& task) {
  try {
    auto integrator = choice.make(model, task);
    model.rethrow();  // an exception that `auto` has caught
    return integrator;
  } catch (const std::exception&) {
    model.rethrow();
    throw;
  }
}

}  // namespace

py::dict integrate(const PythonModel& model, const IntegrateRequest& request) {
  const double end = request.times.back(),
               interval = (end - request.initial.t) / static_cast<double>(request.times.size());
  // The scales are amplitudes of the motion, so their ratio estimates its frequency.
  const Scales scales{request.position_scale, request.velocity_scale, request.velocity_scale / request.position_scale};
  const Task task{[=] { return scales; }, request.initial, end, interval};
  const Config options = Config::from_text(request.integrator, "integrator");
  const auto choice = Registry<IntegratorChoice>::read(options);
  const auto integrator = make_integrator(*choice, model, task);
  std::atomic<bool> interrupt{false};
  Trajectory trajectory(interrupt);
  const Outcome outcome =
      run(model, *integrator, request.initial, {.end = end, .output_times = request.times}, {&trajectory}, interrupt);
  trajectory.rethrow();
  model.rethrow();
  py::dict out;
  trajectory.write(out, model.num_dofs());
  out["status"] = status_word(outcome.status);
  out["message"] = outcome.message;
  py::dict decisions;
  for (const auto& [key, value] : integrator->decisions()) decisions[key.c_str()] = value;
  out["decisions"] = decisions;
  out["statistics"] = statistics_of(integrator->statistics());
  return out;
}

}  // namespace orthodyn::python
