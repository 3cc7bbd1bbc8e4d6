#include "lib/scene/scales.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

double initial_energy(const FemModel& model, const State& state) {
  return model.evaluate("energy.kinetic", state)[0] + model.evaluate("energy.elastic", state)[0];
}

}  // namespace

Scales estimate_scales(const Scene& scene, const BuiltScene& built, const StaticResponse& statics) {
  const FemModel& model = *built.model;
  const double extent = bounding_box(model.parts().mesh).size().maxCoeff();
  const double mass = model.parts().mass->total();
  const bool at_rest = built.initial.q.isZero(0) && built.initial.v.isZero(0);
  const double energy = at_rest ? 0 : initial_energy(model, built.initial);  // not round-off
  if (!std::isfinite(energy)) throw ConfigError("the initial state has no finite energy; check `initial`");
  const double work = statics.exists() ? statics.work : extent * statics.load.lpNorm<1>();
  Scales scales{0.1 * extent, 3 * std::sqrt(2 * (energy + work) / mass)};
  if (statics.exists() && at_rest)
    scales.position = std::min(scales.position, 2 * statics.displacement.cwiseAbs().maxCoeff());
  if (scales.velocity == 0) scales.velocity = extent / (scene.time.end - scene.time.start);
  return scales;
}

Scales estimate_scales(const Scene& scene, const BuiltScene& built) {
  return estimate_scales(scene, built, static_response(*built.model));
}

}  // namespace orthodyn
