// What a run of a scene reports while it works. The library prints nothing: the program does.
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

  // Something is odd about the scene or the folder; the run goes on.
  virtual void on_warning(const std::string& /*text*/) {}

  // What happens next: "resumes at t = 0.2 s; ...".
  virtual void on_notice(const std::string& /*text*/) {}

  // The computation begins. An observer of it, such as a progress bar, or null. Asked again where the run is repeated
  // for an estimate of its error.
  virtual std::unique_ptr<Observer> on_begin(const Setup& /*setup*/) { return nullptr; }

  // The computation is over. What follows: run.json, and the estimate of the error if it was asked for.
  virtual void on_result(const RunResult& /*result*/) {}
};

}  // namespace orthodyn
