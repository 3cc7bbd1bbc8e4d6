// Reports the progress of a run. The library prints nothing; the program does.
#pragma once

#include <memory>
#include <string>

#include "lib/simulation/output/observer.h"
#include "lib/simulation/run/run_result.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

class RunListener {
 public:
  virtual ~RunListener() = default;

  // Called for a warning about the scene or the folder; the run continues.
  virtual void on_warning(const std::string& /*text*/) {}

  // Called for an announcement: "resumes at t = 0.2 s; ...".
  virtual void on_notice(const std::string& /*text*/) {}

  // Called when the computation starts. Returns an observer, such as a progress bar, or null. Called again when the run
  // is repeated to estimate its error.
  virtual std::unique_ptr<Observer> on_begin(const Setup& /*setup*/) { return nullptr; }

  // Called when the computation has ended. The error estimate, if requested, follows.
  virtual void on_result(const RunResult& /*result*/) {}
};

}  // namespace orthodyn
