// Runs a scene from its file to its results, as `orthodyn run` does:
//
//   auto simulation = orthodyn::Simulation::from_file("scene.yaml", {.set = {"integrator.rtol=1e-5"}});
//   const orthodyn::RunResult result = simulation.run({.folder = "out/scene"});
//
// The run writes the outputs of the scene (frames, energies, probes, ...), scene.yaml and run.json into the folder. It
// prints nothing; a RunListener receives its messages. A Simulation is for one thread; several may run in parallel in
// different folders.
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
  // Throws ConfigError for an unreadable file, a file that is not a scene, and a change that does not apply.
  static Simulation from_file(const std::string& file, const SceneChanges& changes = {});

  // A scene given as text. `name` is its file name in messages; relative paths start at the folder of `name`.
  static Simulation from_text(const std::string& text, const std::string& name, const SceneChanges& changes = {});

  // The scene with the changes applied, not yet validated.
  const Config& scene() const { return scene_; }

  // Validates and builds the scene, and runs it. A failed computation does not throw: see RunResult::outcome. Throws
  // ConfigError for an invalid scene or folder before anything is written, RunError if a file cannot be written.
  RunResult run(const RunRequest& request) const;

  // Stops soon after `interrupt` becomes true; the run can then be resumed.
  RunResult run(const RunRequest& request, const std::atomic<bool>& interrupt) const;
  RunResult run(const RunRequest& request, const std::atomic<bool>& interrupt, RunListener& listener) const;

 private:
  RunResult run_once(Config scene, const RunRequest& request, const std::string& restart_reason,
                     const std::atomic<bool>& interrupt, RunListener& listener) const;

  static Simulation from_config(Config scene, const std::string& file, const SceneChanges& changes);

  Simulation(std::string file, SceneChanges changes, Config scene, std::string notice)
      : file_(std::move(file)), changes_(std::move(changes)), scene_(std::move(scene)), notice_(std::move(notice)) {}

  std::string file_;
  SceneChanges changes_;
  Config scene_;        // with the changes
  std::string notice_;  // says which integrator keys the changes dropped; may be ""
};

}  // namespace orthodyn
