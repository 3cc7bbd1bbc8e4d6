// A scene, run from its file to its results as `orthodyn run` does:
//
//   auto simulation = orthodyn::Simulation::from_file("scene.yaml", {.set = {"integrator.rtol=1e-5"}});
//   const orthodyn::RunResult result = simulation.run({.folder = "out/scene"});
//
// writes what the scene asks for (frames, energies, probes, ...), scene.yaml and run.json into the folder. Nothing is
// printed: see RunListener. One simulation is for one thread; several may run side by side in folders of their own.
#pragma once

#include <atomic>
#include <string>
#include <utility>

#include "lib/simulation/run/run_context.h"
#include "lib/simulation/run/run_listener.h"
#include "lib/simulation/run/run_result.h"
#include "lib/simulation/run/scene_file.h"

namespace orthodyn {

class Simulation {
 public:
  // Throws ConfigError for a file that cannot be read, one that is no scene, and a change that does not apply.
  static Simulation from_file(const std::string& file, const SceneChanges& changes = {});

  // The same of a scene as text, called `name` in messages; files that it names are looked for where `name` is.
  static Simulation from_text(const std::string& text, const std::string& name, const SceneChanges& changes = {});

  // With the changes, not validated.
  const Config& scene() const { return scene_; }

  // Validates the scene, builds its model and computes it. A run that could not go on is a result: see its outcome.
  // Throws ConfigError for a scene or a folder that is at fault, before anything is written, and RunError for files
  // that cannot be written.
  RunResult run(const RunRequest& request) const;

  // Ends soon after `interrupt` becomes true, and can then be resumed. The listener is told what happens.
  RunResult run(const RunRequest& request, const std::atomic<bool>& interrupt) const;
  RunResult run(const RunRequest& request, const std::atomic<bool>& interrupt, RunListener& listener) const;

 private:
  RunResult run_once(Config scene, const RunRequest& request, const std::string& given_up,
                     const std::atomic<bool>& interrupt, RunListener& listener) const;

  static Simulation from_config(Config scene, const std::string& file, const SceneChanges& changes);

  Simulation(std::string file, SceneChanges changes, Config scene, std::string notice)
      : file_(std::move(file)), changes_(std::move(changes)), scene_(std::move(scene)), notice_(std::move(notice)) {}

  std::string file_;
  SceneChanges changes_;
  Config scene_;        // with the changes
  std::string notice_;  // of what the changes have left out; may be empty
};

}  // namespace orthodyn
