// The observers of a dynamic run, as requested by the scene: frames, probes, energies, steps, events.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lib/simulation/checkpoint/checkpointer.h"
#include "lib/simulation/output/contact_watch.h"
#include "lib/simulation/output/curves.h"
#include "lib/simulation/output/extremes.h"
#include "lib/simulation/output/frames.h"
#include "lib/simulation/output/joint_watch.h"
#include "lib/simulation/output/setup_file.h"
#include "lib/simulation/output/strain_watch.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/sensitivity/event_sensitivity.h"
#include "lib/simulation/sensitivity/sensitivity_table.h"

namespace orthodyn {

// The columns of probes.csv.
std::vector<ProbeColumn> probe_columns(const Scene& scene, const FemModel& model);

class RunObservers {
 public:
  // Touches no file. `setup` must outlive it.
  RunObservers(const Setup& setup, const std::filesystem::path& folder);

  // The events to find; null if there are none.
  EventFinder* events() { return finder_.empty() ? nullptr : &finder_; }
  std::vector<std::string> events_not_found() const { return finder_.not_found(); }

  // The observers saved in checkpoints, by name.
  NamedObservers checkpointed();
  // All observers, in the order in which they are called; `progress` may be null.
  std::vector<Observer*> all(Observer* progress, Checkpointer& checkpointer);

  // Throws ConfigError before any file is changed.
  void restore(const Checkpoint& checkpoint);

  InversionWatch inversion;
  std::optional<EnergyWriter> energy;
  std::optional<MomentumWriter> momentum;
  std::optional<ExtremeRecorder> extremes;
  std::optional<StrainWatch> strains;
  std::optional<JointWatch> joints;
  std::optional<ContactWatch> contacts;

 private:
  void observe_sensitivities(const Setup& setup, const std::filesystem::path& folder);

  LinearityWatch* linearity_;  // null without linear kinematics
  std::optional<FrameWriter> frames_;
  std::optional<SetupWriter> setup_;
  std::optional<StepWriter> steps_;
  std::optional<ProbeWriter> probes_;
  std::optional<SensitivityWriter> sensitivities_;
  EventFinder finder_;
  std::optional<EventWriter> events_;
  std::optional<MotionSlopes> slopes_;  // used by `extremes` and event_sensitivities_
  std::optional<EventSensitivityWriter> event_sensitivities_;
};

}  // namespace orthodyn
