// Forwards a run's messages and progress to Python, and interrupts the run on a Python exception.
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

// The run does not hold the interpreter's lock; each call into Python takes it. An exception in Python, including
// Ctrl-C, ends the run after the current step; rethrow() then throws it.
class Listener : public RunListener {
 public:
  // `callbacks`: an object with on_warning(text), on_notice(text) and on_progress(t, end), or None. `fields`: names of
  // the outputs to keep in memory; empty for those that the scene writes.
  Listener(pybind11::object callbacks, std::optional<std::vector<std::string>> fields)
      : callbacks_(std::move(callbacks)), fields_(std::move(fields)) {}

  void on_warning(const std::string& text) override { call_python("on_warning", text); }
  void on_notice(const std::string& text) override { call_python("on_notice", text); }
  std::unique_ptr<Observer> on_begin(const Setup& setup) override;
  void on_result(const RunResult&) override { computed_ = true; }

  const std::atomic<bool>& interrupt() const { return interrupt_; }
  void rethrow() const;
  // The recorded states, see Recorder::take(); empty if no run has started.
  pybind11::dict take_recording();

  // Called between steps; reports a few times a second.
  void report_progress(double t, double end);

 private:
  template <class... Words>
  void call_python(const char* name, const Words&... words);

  pybind11::object callbacks_;
  std::optional<std::vector<std::string>> fields_;
  std::shared_ptr<Recorder> recorder_;
  bool computed_ = false;  // true during the error estimate that follows the run
  std::atomic<bool> interrupt_{false};
  std::exception_ptr thrown_;
  std::chrono::steady_clock::time_point last_progress_ = {};
};

}  // namespace orthodyn::python
