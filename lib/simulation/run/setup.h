// From the input to a model and its integrator, ready to run.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lib/config/config.h"
#include "lib/ode/event.h"
#include "lib/ode/integrator.h"
#include "lib/scene/build.h"
#include "lib/simulation/run/kinematics.h"

namespace orthodyn {

struct Setup {
  Config config;  // resolved: every default filled in, the integrator's decisions too
  Scene scene;
  BuiltScene built;                            // with warnings for the user
  std::unique_ptr<Integrator> integrator;      // null in statics
  std::vector<Event> events;                   // of the model
  std::optional<KinematicsChoice> kinematics;  // where the scene leaves them open
  std::unique_ptr<LinearityWatch> linearity;   // to look on at its run; null without linear kinematics
  double wall_seconds = 0, cpu_seconds = 0;    // that the integrator took to be made: its modes, scales and the like

  // That linear kinematics were given up by an earlier attempt, in words.
  void note_given_up(const std::string& reason);
};

// What the scene wants of its integrator. Both must outlive the task.
Task task_of(const Scene& scene, const BuiltScene& built);

// Reads, validates and builds; the input stays as it is. `linear_so_far`: as choose_kinematics() has it. `is_timed`:
// false where the user gave no time span, and the one of the input means nothing. Throws ConfigError.
// `ranks`: those that hold the model together, and all call this; null for this process alone.
Setup set_up(const Config& input, bool linear_so_far = false, bool is_timed = true, const Ranks* ranks = nullptr);

}  // namespace orthodyn
