#include "lib/scene/scales.h"

#include <algorithm>
#include <cmath>

#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

// Gravity and loads at the peaks of their factors, on the free coordinates.
Vector peak_load(const FemModel& model) {
  const auto& parts = model.parts();
  NodalVector sum = NodalVector::Zero(3, parts.rest->cols());
  const NodalVector still = NodalVector::Zero(3, parts.rest->cols());
  for (const auto& load : parts.loads) load->add_peak_force({0, *parts.rest, still}, sum);
  Vector free(model.num_dofs());
  parts.dofs->restrict_to(sum, free);
  return free;
}

struct StaticEstimate {
  double deflection = 0;  // m, the largest coordinate
  double work = 0;        // J
};

// Linear statics about rest; nothing if the body is not held.
std::optional<StaticEstimate> static_estimate(const FemModel& model, const Vector& load) {
  if (load.norm() == 0) return std::nullopt;
  const Vector zero = Vector::Zero(model.num_dofs());
  Linearization at;
  model.linearize(0, zero, zero, TangentKind::gauss_newton, at);
  std::vector<double> values(at.stiffness.size());
  model.combine({0, 0, 1}, at, values.data());
  auto solver = solver_registry().at(model.pattern().symmetric ? "cholmod" : "klu").make();
  solver->analyze(model.pattern());
  if (solver->factor(values.data()) != FactorStatus::ok) return std::nullopt;
  Vector u(load.size()), residual(load.size());
  solver->solve(load, u);
  model.pattern().multiply(values.data(), u, residual);
  const bool solved = u.allFinite() && (residual - load).norm() < 1e-3 * load.norm();
  if (!solved) return std::nullopt;
  return StaticEstimate{u.cwiseAbs().maxCoeff(), u.dot(load)};
}

double initial_energy(const FemModel& model, const State& state) {
  return model.evaluate("energy.kinetic", state)[0] + model.evaluate("energy.elastic", state)[0];
}

}  // namespace

Scales estimate_scales(const Scene& scene, const BuiltScene& built) {
  const FemModel& model = *built.model;
  const double extent = bounding_box(model.parts().mesh).size().maxCoeff();
  const double mass = model.parts().mass->total();
  const double energy = initial_energy(model, built.initial);
  if (!std::isfinite(energy)) throw ConfigError("the initial state has no finite energy; check `initial`");
  const Vector load = peak_load(model);
  const bool at_rest = built.initial.q.isZero(0) && built.initial.v.isZero(0);
  const auto statics = static_estimate(model, load);

  const double work = statics ? statics->work : extent * load.lpNorm<1>();
  Scales scales{0.1 * extent, 3 * std::sqrt(2 * (energy + work) / mass)};
  if (statics && at_rest) scales.position = std::min(scales.position, 2 * statics->deflection);
  if (scales.velocity == 0) scales.velocity = extent / (scene.time.end - scene.time.start);
  return scales;
}

}  // namespace orthodyn
