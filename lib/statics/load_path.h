// The static problem as a model whose time is the load factor lambda in [0, 1]:
//
//     f_lambda(q) = f_s(t, q, 0) + lambda f_l(t, q, 0),  t = t_0 + lambda (t_1 - t_0)
//
// f_l is the force of the loads (Model::load_parts(): loads, pressure, gravity, loading terms of plugins). f_s is the
// force of the structure (elasticity, ground contact, springs, also those that are stretched at rest). A state with
// f_lambda = 0 is an equilibrium under lambda times the loads, dead or following. Supports may move from t_0 to t_1.
//
// The path starts at the equilibrium of the unloaded structure. If the initial shape is not this equilibrium, for
// example because of stretched springs, settling() is a path to it.
//
// If a model does not know its loads (load_parts() is none), its force at the start is applied as a dead load.
#pragma once

#include <memory>
#include <vector>

#include "lib/ode/derived_model.h"

namespace orthodyn {

// The model's times t_0 and t_1 (s); equal if only the loads change.
struct PathTimes {
  PathTimes(double t) : begin(t), end(t) {}  // NOLINT: implicit conversion
  PathTimes(double from, double to) : begin(from), end(to) {}
  double at(double lambda) const { return begin == end ? end : begin + lambda * (end - begin); }
  double begin, end;
};

class LoadPath : public DerivedModel {
 public:
  // `start`: q at lambda = 0, m. `model` must outlive this object. Throws RunError if there is no finite force at the
  // start.
  LoadPath(const Model& model, const PathTimes& times, Vector start);

  // The path f_lambda(q) = f_s(q) - (1 - lambda) f_s(start) from `start` to the equilibrium of the unloaded structure
  // at times.begin. At lambda = 0 the unbalanced force f_s(start) is compensated; the compensation is then removed
  // gradually. Null if that force is zero or the loads are unknown. Throws as the constructor does.
  static std::unique_ptr<LoadPath> settling(const Model& model, const PathTimes& times, Vector start);

  const Vector& start() const { return start_; }
  // df_lambda/dlambda, N. If supports move, lambda outside [0, 1] gives the value at the nearer end. Throws
  // RecoverableError as the model does.
  Vector rate(double lambda, const ConstVectorRef& q) const;
  // The largest component of rate() at the start, N; for dead loads the largest nodal load.
  double largest_load() const { return largest_load_; }
  const PathTimes& times() const { return times_; }
  bool moves_supports() const { return times_.begin != times_.end; }
  // True if rate() is constant, and stored.
  bool has_constant_rate() const { return !moves_supports() && !loads_; }

  const Traits& traits() const override { return traits_; }
  void force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;

  std::vector<OutputInfo> outputs() const override { return original().outputs(); }
  std::unique_ptr<StateView> view(const State& state) const override;
  Geometry geometry() const override { return original().geometry(); }

 private:
  enum class Loaded { yes, no };
  LoadPath(const Model& model, const PathTimes& times, Vector start, Loaded loaded);

  void split_forces(Loaded loaded);
  void classify_loads();
  void assemble(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;
  void assemble_predicted(double lambda_before, const ConstVectorRef& q_before, double lambda, const ConstVectorRef& q,
                          Linearization& out) const override;
  void add_load_tangent(double lambda, const ConstVectorRef& q, TangentKind kind, Linearization& out) const;
  const Model& structure() const { return structure_ ? *structure_ : original(); }

  PathTimes times_;
  Traits traits_;
  Vector start_;
  std::unique_ptr<const Model> structure_;  // null if the loads are unknown
  std::unique_ptr<const Model> loads_;      // null if there are none, or if they are dead and constant
  bool loads_have_tangent_ = false;
  Vector dead_;        // force of dead, constant loads, N; empty if there are none
  Vector unbalanced_;  // unbalanced force at the start in place of loads, N; empty if there is none
  double largest_load_ = 0;
};

}  // namespace orthodyn
