#include "lib/analysis/scales.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"
#include "lib/fem/contact/contact.h"

namespace orthodyn {

namespace {

// The energy E0 of scales.h.
double initial_energy(const FemModel& model, const State& state) {
  const VectorSpace space = model.space();
  double elastic = model.evaluate("energy.elastic", state)[0];
  if (!space.is_zero(state.q)) {
    Vector f(state.q.size());
    model.force(state.t, state.q, Vector::Zero(state.q.size()), f);
    const double released = space.sum_of_sizes(f.cwiseProduct(state.q)) / 2;
    constexpr double kRoundOff = 1e-9;
    elastic = released > kRoundOff * elastic ? std::min(elastic, released) : 0;
  }
  return model.evaluate("energy.kinetic", state)[0] + elastic;
}

// Largest displacement and speed of moved supports and of motors; zero without any.
struct Reach {
  double distance = 0, speed = 0;  // m, m/s
};

constexpr int kSamples = 200;

std::vector<double> sampled_times(const StepLimits& limits, double start, double end) {
  std::vector<double> times = limits.ends();
  for (int k = 0; k < kSamples; ++k) times.push_back(start + (end - start) * golden_ratio_sample(k));
  times.push_back(end);
  return times;
}

// Largest distance at rest of nodes of the first body that hold a turning joint from a point of its line, m.
double arm_of(const Mesh& mesh, const JointCoordinate& coordinate) {
  const Vec3 from = coordinate.points().front().rest;
  double arm = 0;
  for (const auto& [node, weight] : coordinate.points().front().weights)
    arm = std::max(arm, (mesh.node(node) - from).norm());
  return arm;
}

// Of the bodies that motors of joints move.
Reach reach_of_motors(const FemModel& model, double start, double end) {
  const double extent = bounding_box(model.parts().mesh).size().maxCoeff();
  Reach reach;
  for (const Joint& joint : model.parts().joints) {
    const JointEquation* driven = joint.motor();
    if (!driven) continue;
    const double arm = joint.coordinate->is_angle() ? arm_of(model.parts().mesh, *joint.coordinate) : 1;
    for (const double t : sampled_times(driven->motor.factor->step_limits(start, end), start, end)) {
      reach.distance = std::max(reach.distance, std::min(arm * std::abs(driven->motor.value(t)), arm + extent));
      reach.speed = std::max(reach.speed, arm * std::abs(driven->motor.rate(t)));
    }
  }
  return reach;
}

Reach reach_of_supports(const FemModel& model, double start, double end) {
  const auto& parts = model.parts();
  Reach reach;
  const auto& everywhere = parts.subdomain ? parts.moved_everywhere : parts.moved;
  if (!everywhere) return reach;
  for (const double t : sampled_times(everywhere->step_limits(start, end), start, end)) {
    NodalVector u = NodalVector::Zero(3, parts.rest->cols()), v = u;
    parts.moved->place(t, u, v);
    if (u.cols() == 0) continue;
    reach.distance = std::max(reach.distance, u.colwise().norm().maxCoeff());
    reach.speed = std::max(reach.speed, v.colwise().norm().maxCoeff());
  }
  const VectorSpace space = model.space();
  return {space.largest(reach.distance), space.largest(reach.speed)};
}

// Size of the motion (m); 0 if unknown. Loads cause up to twice their static response (less if they are short), and
// initial velocities vibrations of three times their rms amplitude; the initial displacement is added.
double size_of_motion(const VectorSpace& space, const State& initial, const StaticResponse& statics,
                      const Reach& reach) {
  const bool held_by_stiffness = statics.exists();
  const bool moves = !space.is_zero(initial.v), is_moved = reach.distance > 0;
  const bool is_loaded = !space.is_zero(statics.load);
  if (!held_by_stiffness && (moves || is_loaded || !is_moved)) return 0;
  const double deflection = is_loaded ? space.largest_entry(statics.displacement) : 0;
  return 2 * std::max(load_duration_factor(space, statics) * deflection, reach.distance) +
         3 * statics.velocity_amplitude + space.largest_entry(initial.q);
}

constexpr double kLeastShare = 1e-6;  // smallest position scale relative to the extent, well above round-off

// The least Contact::range() of all contacts, m; infinite without contact.
double contact_range(const FemModel& model, double energy) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& term : model.parts().loads)
    if (const Contact* contact = term->contact()) least = std::min(least, contact->range(energy));
  return 1 / model.space().largest(1 / least);
}

}  // namespace

Scales estimate_scales(const FemModel& model, const State& initial, double end, const StaticResponse& statics) {
  const double extent = bounding_box(model.parts().mesh).size().maxCoeff();
  const double mass = model.parts().mass->total();
  const VectorSpace space = model.space();
  const bool at_rest = space.is_zero(initial.q) && space.is_zero(initial.v);
  const double energy = at_rest ? 0 : initial_energy(model, initial);  // avoids round-off at rest
  if (!std::isfinite(energy))
    throw ConfigError("initial", "the state has no finite energy; check velocities and displacements");
  const double reached = statics.exists() ? load_duration_factor(space, statics) : 1;
  const double work = statics.exists()              ? reached * reached * statics.work
                      : space.is_zero(statics.load) ? 0
                                                    : extent * space.sum_of_sizes(statics.load);
  const Reach supports = reach_of_supports(model, initial.t, end), motors = reach_of_motors(model, initial.t, end);
  const Reach reach{std::max(supports.distance, motors.distance), std::max(supports.speed, motors.speed)};
  Scales scales{0.1 * extent, 3 * std::sqrt(2 * (energy + work) / mass + reach.speed * reach.speed)};
  if (const double size = size_of_motion(space, initial, statics, reach); size > 0 && size < scales.position) {
    scales.omega = 2.0 / 3 * scales.velocity / size;
    scales.position = size;
  }
  if (energy + work > 0)
    scales.position = std::min(scales.position, std::max(contact_range(model, energy + work), kLeastShare * extent));
  if (scales.velocity == 0) scales.velocity = extent / (end - initial.t);
  return scales;
}

}  // namespace orthodyn
