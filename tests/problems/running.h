// Runs a built scene with an observer.
#pragma once

#include <functional>

#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"
#include "tests/fem/built_scene.h"

namespace orthodyn {

struct Watch : Observer {
  explicit Watch(std::function<void(const State&)> f) : look(std::move(f)) {}
  void on_start(const ObservedState& observed) override { look(observed.state()); }
  void on_output(const ObservedState& observed) override { look(observed.state()); }
  std::function<void(const State&)> look;
};

// Looks at the end of each step.
struct StepWatch : Observer {
  explicit StepWatch(std::function<void(const State&)> f) : look(std::move(f)) {}
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override {
    if (look) look(observed.state());
  }
  std::function<void(const State&)> look;
};

// Runs to the end of the scene and calls `look` for the start and for `frames` evenly spaced states.
Outcome run_scene(const BuiltTestScene& s, int frames, std::function<void(const State&)> look);

double total_energy(const BuiltTestScene& s, const State& state);

Vec3 momentum(const BuiltTestScene& s, const std::string& kind, const State& state);

}  // namespace orthodyn
