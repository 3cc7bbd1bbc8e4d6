// Tells Python what a run reports, and hears from it that the run is to end.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run/run_listener.h"
#include "tools/python/binding/recorder.h"

namespace orthodyn::python {

// The run goes on without the interpreter's lock, which is taken for each call into Python. An exception there, Ctrl-C
// among them, ends the run after the step that it is in; rethrow() then gives it on.
class Listener : public RunListener {
 public:
  // `told` has on_warning(text), on_notice(text) and on_progress(t, end), or is None. `fields`: what is to be kept in
  // memory; none: what the scene writes.
  Listener(pybind11::object told, std::optional<std::vector<std::string>> fields)
      : told_(std::move(told)), fields_(std::move(fields)) {}

  void on_warning(const std::string& text) override { tell("on_warning", text); }
  void on_notice(const std::string& text) override { tell("on_notice", text); }
  std::unique_ptr<Observer> on_begin(const Setup& setup) override;
  void on_result(const RunResult&) override { computed_ = true; }

  const std::atomic<bool>& interrupt() const { return interrupt_; }
  void rethrow() const;
  // What was kept; empty where nothing was.
  pybind11::dict take_recording();

  // Between steps, a few times a second.
  void look_up(double t, double end);

 private:
  template <class... Words>
  void tell(const char* name, const Words&... words);

  pybind11::object told_;
  std::optional<std::vector<std::string>> fields_;
  std::shared_ptr<Recorder> recorder_;
  bool computed_ = false;  // what follows is the estimate of the error
  std::atomic<bool> interrupt_{false};
  std::exception_ptr thrown_;
  std::chrono::steady_clock::time_point last_look_ = {};
};

}  // namespace orthodyn::python
