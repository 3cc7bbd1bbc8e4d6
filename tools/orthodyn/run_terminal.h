// Prints the warnings, progress and summary of a run to the terminal.
#pragma once

#include <memory>
#include <string>

#include "lib/simulation/run/run_listener.h"

namespace orthodyn {

class RunTerminal : public RunListener {
 public:
  // `quiet`: prints warnings and errors only.
  explicit RunTerminal(bool quiet);
  ~RunTerminal() override;

  void on_warning(const std::string& text) override;
  void on_notice(const std::string& text) override;
  std::unique_ptr<Observer> on_begin(const Setup& setup) override;
  void on_result(const RunResult& result) override;

 private:
  class SlowSetUpNotice;
  bool quiet_;
  std::unique_ptr<SlowSetUpNotice> slow_set_up_;  // until the run begins
};

}  // namespace orthodyn
