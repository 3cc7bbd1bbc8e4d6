// Everything that looks on while a scene is run, as the scene asks.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lib/simulation/checkpointer.h"
#include "lib/simulation/curves.h"
#include "lib/simulation/event_writer.h"
#include "lib/simulation/progress.h"
#include "lib/simulation/vtu.h"
#include "lib/simulation/setup.h"

namespace orthodyn {

// The columns of probes.csv that a scene asks for.
std::vector<ProbeColumn> probe_columns(const Scene& scene, const FemModel& model);

class RunObservers {
 public:
  // Touches no file. `setup` must outlive it.
  RunObservers(const Setup& setup, const std::filesystem::path& folder, bool quiet);

  // What the run is to look for; null if nothing.
  EventFinder* events() { return finder_.empty() ? nullptr : &finder_; }

  // Those that a checkpoint keeps, by name.
  NamedObservers kept();
  // In the order in which they look on.
  std::vector<Observer*> all(Checkpointer& checkpointer);

  // Throws ConfigError, before anything is changed on the disk.
  void restore(const Checkpoint& checkpoint);

  InversionWatch inversion;
  std::optional<EnergyWriter> energy;
  std::optional<MomentumWriter> momentum;

 private:
  std::optional<VtuWriter> frames_;
  std::optional<StepWriter> steps_;
  std::optional<ProbeWriter> probes_;
  EventFinder finder_;
  std::optional<EventWriter> events_;
  std::optional<Progress> progress_;
};

}  // namespace orthodyn
