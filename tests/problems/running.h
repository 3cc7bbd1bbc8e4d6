// Runs a built scene and looks on.
#pragma once

#include <functional>

#include "lib/run/run.h"
#include "lib/scene/setup.h"
#include "tests/fem/built_scene.h"

namespace orthodyn {

struct Watch : Observer {
  explicit Watch(std::function<void(const State&)> f) : look(std::move(f)) {}
  void on_start(const State& state) override { look(state); }
  void on_output(const State& state) override { look(state); }
  std::function<void(const State&)> look;
};

// To the scene's end; `look` sees the start and `frames` evenly spaced states.
inline Outcome run_scene(const BuiltTestScene& s, int frames, std::function<void(const State&)> look) {
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  const Plan plan{s.scene.time.end, evenly_spaced(s.scene.time.start, s.scene.time.end, frames)};
  Watch watch(std::move(look));
  return run(s.model(), *integrator, s.built.initial, plan, {&watch}, {false});
}

inline double total_energy(const BuiltTestScene& s, const State& state) {
  return s.model().evaluate("energy.elastic", state)[0] + s.model().evaluate("energy.kinetic", state)[0] +
         s.model().evaluate("energy.gravitational", state)[0];
}

inline Vec3 momentum(const BuiltTestScene& s, const std::string& kind, const State& state) {
  return Eigen::Map<const Vec3>(s.model().evaluate("momentum." + kind, state).data());
}

}  // namespace orthodyn
