// Drives a static analysis: load steps from zero to full load. Observers receive each equilibrium as an output, whose
// "time" is its load factor.
#pragma once

#include <atomic>
#include <filesystem>

#include "lib/simulation/output/files.h"
#include "lib/simulation/run/outcome.h"
#include "lib/statics/load_stepper.h"

namespace orthodyn {

// Returns an Outcome whose last state is the last equilibrium, also if the computation fails; does not throw. `model`:
// evaluates the outputs for the observers.
Outcome run_static(const Model& model, LoadStepper& stepper, const std::vector<Observer*>& observers,
                   const std::atomic<bool>& interrupt);

// Writes load_steps.csv. Each row describes an equilibrium: load factor, Newton iterations, residual, largest
// displacement, number of unstable directions (nan if unknown), and energies.
class LoadStepWriter : public Observer {
 public:
  // `stepper` must outlive the writer.
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
