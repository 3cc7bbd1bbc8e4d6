// Writes a checkpoint at the start, every so often (where writing is slow, less often: that it takes no
// more than about a tenth of the time), and when it is told to.
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

// Observers by the name under which a checkpoint knows them.
using NamedObservers = std::vector<std::pair<std::string, Observer*>>;

struct CheckpointTimes {
  double every = 60;   // s of wall time
  int frames = 0;      // and after so many outputs; 0: not by outputs
  bool never = false;  // only when told to
};

// To be the last of the observers: what the others keep is then that of the same state.
class Checkpointer : public Observer {
 public:
  // `begin` holds what does not change, and what earlier parts of the run have cost. The others, the model and the
  // integrator must outlive it.
  Checkpointer(std::filesystem::path path, Checkpoint begin, CheckpointTimes times, NamedObservers others,
               const FemModel& model, const Integrator& integrator);

  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override;
  void on_history(const ObservedState& observed) override;
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

  // Between steps only. Throws RunError.
  void write(const State& state);

  // Where there is no schedule: a state of a second ago or so, between steps, for a run that an observer has ended in
  // the middle of one (a full disk). False if there is none. Throws RunError.
  bool write_remembered();

 private:
  using Clock = std::chrono::steady_clock;
  Effort effort() const;
  void start_clock();
  void take(const State& state);
  void remember_now_and_then(const State& state);
  bool for_all_ranks(bool decision) const;

  std::filesystem::path path_;
  Checkpoint checkpoint_;
  std::optional<Checkpoint> remembered_;
  Effort before_;
  CheckpointTimes times_;
  NamedObservers others_;
  const FemModel& model_;
  const Integrator& integrator_;
  Clock::time_point begin_, written_;
  double begin_cpu_ = 0;
  double last_took_ = 0;  // s, to write
  int outputs_ = 0;       // since the last one
};

}  // namespace orthodyn
