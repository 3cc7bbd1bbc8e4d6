// Drives a static analysis: load steps from nothing to all loads. Observers see each equilibrium as an output, whose
// "time" is its load factor.
#pragma once

#include <atomic>
#include <filesystem>

#include "lib/ode/load_stepper.h"
#include "lib/simulation/files.h"
#include "lib/simulation/outcome.h"

namespace orthodyn {

// Never throws for a computation that could not go on: that is an Outcome, whose last state is the last equilibrium.
Outcome run_static(LoadStepper& stepper, const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt);

// load_steps.csv: for each equilibrium what it took, how well it holds, and how large the motion is; energies, where
// the model tells them.
class LoadStepWriter : public Observer {
 public:
  // `model` and `stepper` must outlive it.
  LoadStepWriter(const std::filesystem::path& path, const Model& model, const LoadStepper& stepper);
  void on_start(const State& state) override;
  void on_output(const State& state) override { write(state); }

 private:
  void write(const State& state);

  const Model& model_;
  const LoadStepper& stepper_;
  std::vector<std::string> energies_;
  CsvFile file_;
};

}  // namespace orthodyn
