#include "lib/statics/load_path.h"

#include <algorithm>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

Vector force_at_rest(const Model& model, double t, const ConstVectorRef& q) {
  Vector f(q.size());
  model.force(t, q, Vector::Zero(q.size()), f);
  return f;
}

}  // namespace

LoadPath::LoadPath(const Model& model, const PathTimes& times, Vector start)
    : LoadPath(model, times, std::move(start), Loaded::yes) {}

std::unique_ptr<LoadPath> LoadPath::settling(const Model& model, const PathTimes& times, Vector start) {
  if (!model.load_parts()) return nullptr;
  std::unique_ptr<LoadPath> path(new LoadPath(model, times.begin, std::move(start), Loaded::no));
  return path->largest_load() > 0 ? std::move(path) : nullptr;
}

LoadPath::LoadPath(const Model& model, const PathTimes& times, Vector start, Loaded loaded)
    : DerivedModel(model), times_(times), traits_(model.traits()), start_(std::move(start)) {
  bool is_finite = false;
  try {
    split_forces(loaded);
    const Vector first = rate(0, start_);
    largest_load_ = space().largest_entry(first);
    is_finite = space().is_finite(first);
  } catch (const RecoverableError& e) {
    throw RunError(std::string("the forces cannot be evaluated at the start: ") + e.what(), Reason::force);
  }
  if (!is_finite) throw RunError("the forces at the start are not finite; check the loads", Reason::force);
}

void LoadPath::split_forces(Loaded loaded) {
  const auto load_parts = original().load_parts();
  if (!load_parts) {
    unbalanced_ = force_at_rest(original(), times_.begin, start_);
    return;
  }
  structure_ = without_loads(original());
  if (loaded == Loaded::no) {
    unbalanced_ = force_at_rest(*structure_, times_.begin, start_);
  } else if (!load_parts->empty()) {
    loads_ = original().only(*load_parts);
    classify_loads();
  }
}

void LoadPath::classify_loads() {
  Linearization at;
  loads_->linearize(times_.begin, start_, Vector::Zero(start_.size()), TangentKind::exact, at);
  const bool has_tangent_here = std::any_of(at.stiffness.begin(), at.stiffness.end(), [](double k) { return k != 0; });
  loads_have_tangent_ = space().any(has_tangent_here) || !loads_->traits().linear;
  if (loads_have_tangent_) {
    traits_.linear = false;  // K changes with the load factor
  } else if (!moves_supports()) {
    dead_ = force_at_rest(*loads_, times_.end, start_);
    loads_.reset();
  }
}

void LoadPath::force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  const double t = times_.at(lambda);
  structure().force(t, q, v, f);
  if (unbalanced_.size() > 0) f -= (1 - lambda) * unbalanced_;
  if (dead_.size() > 0) f += lambda * dead_;
  if (!loads_) return;
  Vector loads(q.size());
  loads_->force(t, q, v, loads);
  f += lambda * loads;
}

Vector LoadPath::rate(double lambda, const ConstVectorRef& q) const {
  if (!moves_supports()) {
    if (loads_) return force_at_rest(*loads_, times_.end, q);
    return unbalanced_.size() > 0 ? unbalanced_ : dead_.size() > 0 ? dead_ : Vector(Vector::Zero(q.size()));
  }
  constexpr double kStep = 1e-5;  // step of lambda; truncation (step squared) and round-off each cause errors of 1e-10
  const Vector still = Vector::Zero(q.size());
  const auto force_at = [&](double factor) {
    Vector f(q.size());
    force(factor, q, still, f);
    return f;
  };
  const double at = std::clamp(lambda, 0.0, 1.0), inwards = at < kStep ? 1 : at > 1 - kStep ? -1 : 0;
  if (inwards == 0) return (force_at(at + kStep) - force_at(at - kStep)) / (2 * kStep);
  const double step = inwards * kStep;
  return (4 * force_at(at + step) - 3 * force_at(at) - force_at(at + 2 * step)) / (2 * step);
}

std::unique_ptr<StateView> LoadPath::view(const State& state) const {
  return original().view({times_.at(state.t), state.q, state.v, state.t});
}

void LoadPath::assemble(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                        Linearization& out) const {
  structure().linearize(times_.at(lambda), q, v, kind, out);
  add_load_tangent(lambda, q, kind, out);
}

void LoadPath::assemble_predicted(double lambda_before, const ConstVectorRef& q_before, double lambda,
                                  const ConstVectorRef& q, Linearization& out) const {
  structure().linearize_predicted(times_.at(lambda_before), q_before, times_.at(lambda), q, out);
  add_load_tangent(lambda, q, TangentKind::exact, out);
}

void LoadPath::add_load_tangent(double lambda, const ConstVectorRef& q, TangentKind kind, Linearization& out) const {
  if (!loads_have_tangent_ || lambda == 0) return;
  Linearization loads;
  loads_->linearize(times_.at(lambda), q, Vector::Zero(q.size()), kind, loads);
  for (std::size_t k = 0; k < out.stiffness.size(); ++k) out.stiffness[k] += lambda * loads.stiffness[k];
}

}  // namespace orthodyn
