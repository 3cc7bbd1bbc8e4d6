// Example of a user's program that runs a scene from a file: it changes a key of the scene, reads each output during
// the run, and reports the result.
//   run_scene SCENE.yaml FOLDER
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>

#include "lib/simulation/run/result_warnings.h"
#include "lib/simulation/simulation.h"

namespace {

using namespace orthodyn;

// Prints the largest displacement and the elastic energy at each output during the run.
class LargestDisplacement : public Observer {
 public:
  void on_output(const ObservedState& observed) override {
    const auto u = observed.evaluate("displacement");  // three components for each node (m)
    double largest = 0;
    for (const double component : u) largest = std::max(largest, std::abs(component));
    fmt::print("t = {:.4f} s: largest component of displacement {:.4g} m, elastic energy {:.4g} J\n", observed.t(),
               largest, observed.evaluate("energy.elastic")[0]);
  }
};

class Listener : public RunListener {
 public:
  void on_warning(const std::string& text) override { fmt::print("warning: {}\n", text); }
  std::unique_ptr<Observer> on_begin(const Setup&) override { return std::make_unique<LargestDisplacement>(); }
};

int run(const std::string& scene, const std::string& folder) {
  const auto simulation = Simulation::from_file(scene, {.set = {"output.frames=10"}});
  const std::atomic<bool> interrupt{false};
  Listener listener;
  const RunResult result = simulation.run({.folder = folder, .force = true}, interrupt, listener);
  for (const auto& warning : result_warnings(result)) fmt::print("warning: {}\n", warning);
  if (result.outcome.status != Outcome::Status::completed) {
    fmt::print("stopped at t = {} s: {}\n", result.outcome.last.t, result.outcome.message);
    return 3;
  }
  if (result.motion)
    fmt::print("{} steps, {} factorisations; files are in {}\n", result.motion->cost.statistics.steps,
               result.motion->cost.statistics.factorization.count, result.folder.string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print("usage: run_scene SCENE.yaml FOLDER\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2]);
  } catch (const ConfigError& error) {  // file:line: key: what was found, what is allowed
    fmt::print("error: {}\n", error.what());
    return 2;
  }
}
