#include "tests/problems/running.h"

namespace orthodyn {

Outcome run_scene(const BuiltTestScene& s, int frames, std::function<void(const State&)> look) {
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  const Plan plan{s.scene.time.end, evenly_spaced(s.scene.time.start, s.scene.time.end, frames)};
  Watch watch(std::move(look));
  return run(s.model(), *integrator, s.built.initial, plan, {&watch}, {false});
}

double total_energy(const BuiltTestScene& s, const State& state) {
  return s.model().evaluate("energy.elastic", state)[0] + s.model().evaluate("energy.kinetic", state)[0] +
         s.model().evaluate("energy.gravitational", state)[0];
}

Vec3 momentum(const BuiltTestScene& s, const std::string& kind, const State& state) {
  return Eigen::Map<const Vec3>(s.model().evaluate("momentum." + kind, state).data());
}

}  // namespace orthodyn
