// Builds a model and its integrator from the input.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lib/config/config.h"
#include "lib/ode/event.h"
#include "lib/ode/integrator.h"
#include "lib/scene/build.h"
#include "lib/simulation/run/kinematics.h"
#include "lib/simulation/sensitivity/motion_sensitivity.h"

namespace orthodyn {

struct Setup {
  Config config;  // resolved: all defaults and the integrator's decisions included
  Scene scene;
  BuiltScene built;                                  // includes warnings for the user
  std::unique_ptr<MotionSensitivity> sensitivities;  // of a motion; null if none are wanted
  std::unique_ptr<Integrator> integrator;            // null in statics
  std::vector<Event> events;
  std::optional<KinematicsChoice> kinematics;  // if the scene has `kinematics: auto`
  std::unique_ptr<LinearityWatch> linearity;   // watches the run; null without linear kinematics
  double wall_seconds = 0, cpu_seconds = 0;    // time to construct the integrator, with its scales and modes

  // Records why an earlier attempt with linear kinematics was abandoned.
  void note_kinematics_restart(const std::string& reason);
};

// The integration task of a scene. Both arguments must outlive the task.
Task task_of(const Scene& scene, const BuiltScene& built);

// Reads and checks a scene, and builds its model and integrator; `input` is not changed. `resumes_linear`: see
// choose_kinematics(). `is_timed`: false skips the checks of the time span. `ranks`: the MPI ranks that share the
// model, or null; all ranks must call this function together. Throws ConfigError, or RunError if `start: equilibrium`
// finds no equilibrium.
Setup set_up(const Config& input, bool resumes_linear = false, bool is_timed = true, const Ranks* ranks = nullptr);

}  // namespace orthodyn
