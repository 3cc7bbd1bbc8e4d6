#include "tools/python/binding/listener.h"

#include "tools/python/binding/arrays.h"

namespace orthodyn::python {

namespace {

constexpr auto kProgressInterval = std::chrono::milliseconds(100);

// Observer that the run owns. Forwards to the recorder, which outlives the run, and reports progress.
class RecorderObserver : public Observer {
 public:
  RecorderObserver(std::shared_ptr<Recorder> recorder, Listener& listener, double end)
      : recorder_(std::move(recorder)), listener_(listener), end_(end) {}

  void on_start(const ObservedState& observed) override {
    if (recorder_) recorder_->on_start(observed);
  }
  void on_resume(const ObservedState& observed) override {
    if (recorder_) recorder_->on_resume(observed);
  }
  void on_output(const ObservedState& observed) override {
    if (recorder_) recorder_->on_output(observed);
  }
  void on_step(const StepInfo& step, const ObservedState&, const Integrator&) override {
    listener_.report_progress(step.t, end_);
  }

 private:
  std::shared_ptr<Recorder> recorder_;
  Listener& listener_;
  double end_;
};

}  // namespace

template <class... Words>
void Listener::call_python(const char* name, const Words&... words) {
  const py::gil_scoped_acquire lock;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!callbacks_.is_none()) callbacks_.attr(name)(words...);
  } catch (...) {
    if (!thrown_) thrown_ = std::current_exception();
    interrupt_ = true;
  }
}

std::unique_ptr<Observer> Listener::on_begin(const Setup& setup) {
  if (computed_) return std::make_unique<RecorderObserver>(nullptr, *this, setup.scene.time.end);
  recorder_ = std::make_shared<Recorder>(*setup.built.model, fields_.value_or(setup.scene.output.fields));
  return std::make_unique<RecorderObserver>(recorder_, *this, setup.scene.time.end);
}

void Listener::report_progress(double t, double end) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_progress_ < kProgressInterval) return;
  last_progress_ = now;
  call_python("on_progress", t, end);
}

void Listener::rethrow() const {
  if (thrown_) std::rethrow_exception(thrown_);
}

py::dict Listener::take_recording() { return recorder_ ? recorder_->take() : py::dict(); }

}  // namespace orthodyn::python
