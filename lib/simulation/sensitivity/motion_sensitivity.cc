#include "lib/simulation/sensitivity/motion_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lib/core/errors.h"
#include "lib/linear/solver.h"
#include "lib/scene/initial.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

bool has_exact_tangent(const Scene& scene, const FemModel& model) {
  const Traits& traits = model.traits();
  const bool turns = traits.damping_matrix && !traits.linear;
  return traits.exact_stiffness && !turns && !has_unsymmetric_load(scene, model.parts().mesh);
}

bool may_have_constraints(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(),
                     [](const JointInput& joint) { return joint.type != JointType::strut; }) ||
         std::any_of(scene.regions.begin(), scene.regions.end(),
                     [](const auto& region) { return region.second.rigid.is_rigid; });
}

// A kink in time that moves with the parameter would add a jump to the derivative.
void require_fixed_breakpoints(const ChangedModels& changed, const FemModel& model, const Scene& scene,
                               const SceneParameter& parameter, const SourceLocation& origin) {
  const auto& [start, end] = scene.time;
  const std::vector<double> expected = model.breakpoints(start, end);
  for (const auto& one : changed.models())
    if (one.model().breakpoints(start, end) != expected)
      origin.fail(
          fmt::format("'{}' changes a time at which a load has a kink or jumps; derivatives with respect to "
                      "such times are not computed",
                      parameter.path()));
}

}  // namespace

bool has_motion_sensitivity(const Config& config, const Scene& scene, const std::vector<std::string>& paths) {
  if (scene.is_static() || !scene.integrator->computes_sensitivities()) return false;
  if (!has_value_at(config, "integrator.type") || value_at(config, "integrator.type").text() == "auto") return false;
  if (may_have_constraints(scene)) return false;
  Traits traits;
  for (const TermChoice* term : scene.force_terms()) term->declare(traits);
  for (const JointInput& joint : scene.joints) joint.declare(traits);
  return traits.smooth && std::none_of(paths.begin(), paths.end(), [](const std::string& path) {
           return path.find(".factor.") != std::string::npos || path.find(".kinks.") != std::string::npos;
         });
}

MotionSensitivity::MotionSensitivity(const Config& config, const Scene& scene, const BuiltScene& built,
                                     const std::vector<std::string>& paths, const SourceLocation& origin)
    : scene_(scene),
      model_(*built.model),
      small_(small_displacement(model_)),
      has_tangent_(has_exact_tangent(scene, model_)) {
  if (model_.constraints())
    origin.fail(
        "are not computed for motions with joints or free rigid bodies: remove them, or compute differences between "
        "runs");
  if (!model_.traits().smooth)
    origin.fail("are not computed with contact or stops: the force has kinks, at which the motion has no derivative");
  for (const SceneParameter& one : model_parameters(config, paths, origin)) {
    parameters_.push_back(one);
    changed_.emplace_back(config, model_, one, ChangeCount::two, ChangedMotion::as_given);
    require_fixed_breakpoints(changed_.back(), model_, scene, one, origin);
    initial_.push_back(initial_derivative(count() - 1, config, built.initial));
  }
}

State MotionSensitivity::initial_derivative(int i, const Config& config, const State& start) const {
  State slope{start.t, Vector::Zero(start.q.size()), Vector::Zero(start.v.size())};
  if (scene_.start == Start::rest) {
    slope.q = changed(i).derivative([](const ChangedModels::Changed& one) { return one.built.initial.q; });
    slope.v = changed(i).derivative([](const ChangedModels::Changed& one) { return one.built.initial.v; });
    return slope;
  }
  // K dq/dp = df/dp, with supports at rest.
  const Vector zero = Vector::Zero(start.q.size());
  const ChangedModels at_rest_too(config, model_, parameter(i), ChangeCount::two, ChangedMotion::still);
  const Vector load = at_rest_too.derivative(
      [&](const ChangedModels::Changed& one) { return residual(one.model(), start.t, start.q, zero, zero); });
  const bool is_general = has_unsymmetric_load(scene_, model_.parts().mesh);
  const BuiltScene resting =
      build(at_rest(scene_), nullptr, is_general ? MatrixStorage::general : MatrixStorage::by_elasticity);
  const FemModel& model = *resting.model;
  Linearization tangent;
  model.linearize(start.t, start.q, zero, TangentKind::exact, tangent);
  std::vector<double> values(model.pattern().row.size());
  model.combine({0, 0, 1}, tangent, values.data());
  const auto factor =
      model.pattern().symmetric ? make_indefinite_solver(model.pattern()) : make_solver_for(model.pattern());
  if (factor->factor(values.data()) != FactorStatus::ok)
    throw RunError(
        "start: equilibrium: the stiffness is singular, so that the sensitivities of the start do not exist");
  factor->solve(load, slope.q);
  // The velocity depends on the parameter and on the shape, linearly.
  const auto velocity = [&](const FemModel& of, const std::optional<Initial>& initial, const Vector& q) {
    return initial_state_at(q, initial, start.t, of).v;
  };
  slope.v = changed(i).derivative(
      [&](const ChangedModels::Changed& one) { return velocity(one.model(), one.scene.initial, start.q); });
  slope.v += velocity(model_, scene_.initial, start.q + slope.q) - velocity(model_, scene_.initial, start.q);
  return slope;
}

Vector MotionSensitivity::residual(const FemModel& model, double t, const ConstVectorRef& q, const ConstVectorRef& v,
                                   const ConstVectorRef& a) const {
  Vector force(q.size()), inertia(q.size());
  model.force(t, q, v, force);
  model.multiply_mass(a, inertia);
  return force - inertia;
}

void MotionSensitivity::move_to(double t, const ConstVectorRef& q, const ConstVectorRef& v, const ConstVectorRef& a) {
  if (!at_.partial.empty() && at_.t == t && at_.q == q && at_.v == v && at_.a == a) return;
  at_.partial.clear();
  at_.t = t;
  at_.q = q;
  at_.v = v;
  at_.a = a;
  if (has_tangent_ && (at_.stiffness.empty() || !model_.traits().linear)) {
    const std::size_t entries = model_.pattern().row.size();
    model_.linearize(t, q, v, TangentKind::exact, at_.tangent);
    at_.stiffness.resize(entries);
    at_.damping.resize(entries);
    model_.combine({0, 0, 1}, at_.tangent, at_.stiffness.data());
    model_.combine({0, 1, 0}, at_.tangent, at_.damping.data());
    if (std::all_of(at_.damping.begin(), at_.damping.end(), [](double d) { return d == 0; })) at_.damping.clear();
  }
  std::vector<Vector> partial;
  for (int i = 0; i < count(); ++i)
    partial.push_back(
        changed(i).derivative([&](const ChangedModels::Changed& one) { return residual(one.model(), t, q, v, a); }));
  at_.partial = std::move(partial);
}

void MotionSensitivity::force(int i, double t, const ConstVectorRef& q, const ConstVectorRef& v,
                              const ConstVectorRef& a, const ConstVectorRef& s, const ConstVectorRef& s_dot,
                              VectorRef out) {
  move_to(t, q, v, a);
  tangential_force(s, s_dot, out);
  out = at_.partial[static_cast<std::size_t>(i)] - out;
}

void MotionSensitivity::tangential_force(const ConstVectorRef& s, const ConstVectorRef& s_dot, VectorRef out) const {
  Vector other(s.size());
  if (has_tangent_) {
    model_.multiply_matrix(at_.stiffness.data(), s, out);
    if (at_.damping.empty()) return;
    model_.multiply_matrix(at_.damping.data(), s_dot, other);
    out += other;
    return;
  }
  const double largest = std::max(s.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
  const double h = small_ / (s.isZero(0) ? std::max(s_dot.lpNorm<Eigen::Infinity>(), small_) : largest);
  model_.force(at_.t, at_.q - h * s, at_.v - h * s_dot, out);
  model_.force(at_.t, at_.q + h * s, at_.v + h * s_dot, other);
  out = (out - other) / (2 * h);
}

Eigen::VectorXd MotionSensitivity::derivative(int i, const State& state, const State& slope,
                                              const SceneOutputs& outputs) const {
  const Eigen::VectorXd at_fixed_state =
      changed(i).derivative([&](const ChangedModels::Changed& one) { return outputs(one.scene, one.model(), state); });
  return at_fixed_state + derivative_along(slope, parameter(i).usual_change(), scene_, model_, state, outputs);
}

}  // namespace orthodyn
