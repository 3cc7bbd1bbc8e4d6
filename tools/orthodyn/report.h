// What a run was and did: run.json and the summary on the terminal.
#pragma once

#include <filesystem>
#include <string>

#include "lib/run/curves.h"
#include "lib/run/run.h"
#include "tools/orthodyn/setup.h"

namespace orthodyn {

// Follows the smallest det F over all steps: an element with det F <= 0 is inverted.
class InversionWatch : public Observer {
 public:
  explicit InversionWatch(const Model& model) : model_(model) {}
  void on_start(const State& state) override { look(state); }
  void on_step(const StepInfo&, const State& state, const Integrator&) override { look(state); }

  double smallest() const { return smallest_; }
  int element() const { return element_; }
  double time() const { return time_; }

 private:
  void look(const State& state);
  const Model& model_;
  double smallest_ = 1, time_ = 0;
  int element_ = -1;
};

struct RunReport {
  const RunArguments& arguments;
  const Setup& setup;
  const Outcome& outcome;
  const InversionWatch& inversion;
  const EnergyWriter* energy;      // null if not written
  const MomentumWriter* momentum;  // likewise
};

// `report` null: the run has begun.
std::string run_json(const RunArguments& arguments, const RunReport* report);

void print_summary(const RunReport& report, const std::filesystem::path& folder);

}  // namespace orthodyn
