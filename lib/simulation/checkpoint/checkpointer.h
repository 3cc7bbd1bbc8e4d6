// Writes checkpoints at the start, at intervals and on request. On a slow disk the intervals become longer, so that
// writing takes at most about a tenth of the run time.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

// Observers by their names in a checkpoint.
using NamedObservers = std::vector<std::pair<std::string, Observer*>>;

struct CheckpointTimes {
  double every = 60;   // s of wall time
  int frames = 0;      // also write after this many outputs; 0: outputs do not count
  bool never = false;  // write on request only
};

// Must be the last observer called, so that the states of all observers belong to the same time.
class Checkpointer : public Observer {
 public:
  // `begin` holds the constant parts of the checkpoint and the cost of earlier runs. `others`, the model and the
  // integrator must outlive the checkpointer.
  Checkpointer(std::filesystem::path path, Checkpoint begin, CheckpointTimes times, NamedObservers others,
               const FemModel& model, const Integrator& integrator);

  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override;
  void on_history(const ObservedState& observed) override;
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

  // Writes a checkpoint with this state. Call between steps only. Throws RunError.
  void write(const State& state);

  // For a run without scheduled checkpoints that an observer ended within a step, for example because the disk is full.
  // Writes the last remembered state, which is usually about a second old. False if none is remembered. Throws
  // RunError.
  bool write_remembered();

 private:
  using Clock = std::chrono::steady_clock;
  TotalCost cost() const;
  void start_clock();
  void capture(const State& state);
  void remember_periodically(const State& state);
  bool for_all_ranks(bool decision) const;

  std::filesystem::path path_;
  Checkpoint checkpoint_;
  std::optional<Checkpoint> remembered_;
  TotalCost before_;
  CheckpointTimes times_;
  NamedObservers others_;
  const FemModel& model_;
  const Integrator& integrator_;
  Clock::time_point begin_, written_;
  double begin_cpu_ = 0;
  double write_seconds_ = 0;  // time to write the last checkpoint, s
  int outputs_ = 0;           // number of outputs since the last checkpoint
};

}  // namespace orthodyn
