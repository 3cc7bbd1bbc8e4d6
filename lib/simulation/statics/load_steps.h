// Drives a static analysis: load steps from nothing to all loads. Observers see each equilibrium as an output, whose
// "time" is its load factor.
#pragma once

#include <atomic>
#include <filesystem>

#include "lib/simulation/output/files.h"
#include "lib/simulation/run/outcome.h"
#include "lib/statics/load_stepper.h"

namespace orthodyn {

// Never throws for a computation that could not go on: that is an Outcome, whose last state is the last equilibrium.
// `model` is what the observers may ask about.
Outcome run_static(const Model& model, LoadStepper& stepper, const std::vector<Observer*>& observers,
                   const std::atomic<bool>& interrupt);

// load_steps.csv: for each equilibrium what it took, how well it holds, how large the motion is, in how many directions
// it is unstable (nan where K does not tell); energies, where the model tells them.
class LoadStepWriter : public Observer {
 public:
  // `stepper` must outlive it.
  LoadStepWriter(const std::filesystem::path& path, const Model& model, const LoadStepper& stepper);
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override { write(observed); }

 private:
  void write(const ObservedState& observed);

  const LoadStepper& stepper_;
  VectorSpace space_;
  std::vector<std::string> energies_;
  CsvFile file_;
};

}  // namespace orthodyn
