// A body at rest while its loads grow, as a model whose time is the load factor lambda in [0, 1]:
//
//     f_lambda(q) = f_s(t, q, 0) + lambda f_l(t, q, 0),  t = t_0 + lambda (t_1 - t_0)
//
// f_l is the force of what loads the body (Model::load_parts(): loads, pressure, gravity, loading terms of plugins),
// f_s that of the structure: elasticity, springs, ground, with springs that are stretched at rest. Every state with
// f_lambda = 0 is an equilibrium under lambda times the loads, whether these follow the body or not. Supports may move
// from t_0 to t_1.
//
// The path begins where the structure rests without loads. Where its start shape is not that (springs of another
// length), settling() is a path to it.
//
// A model that does not tell its loads is taken to be loaded by its force at the start, as a dead load.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/ode/model.h"

namespace orthodyn {

// The model's times along a path, s; one, where nothing but loads grows.
struct PathTimes {
  PathTimes(double t) : begin(t), end(t) {}  // NOLINT: a time is the times of a path
  PathTimes(double from, double to) : begin(from), end(to) {}
  double at(double lambda) const { return begin == end ? end : begin + lambda * (end - begin); }
  double begin, end;
};

class LoadPath : public Model {
 public:
  // start: q at lambda = 0, m. `model` must outlive it. Throws RunError where it has no force.
  LoadPath(const Model& model, const PathTimes& times, Vector start);

  // From `start` to where the structure rests without loads, at times.begin: f_s(q) - (1 - lambda) f_s(start), so that
  // the force that is out of balance at `start` grows as a dead load. Null where there is none. Throws as above.
  static std::unique_ptr<LoadPath> settling(const Model& model, const PathTimes& times, Vector start);

  const Vector& start() const { return start_; }
  // df_lambda/dlambda, N; beyond [0, 1], where supports stand still, that at the nearer end. Throws RecoverableError
  // where the model does.
  Vector rate(double lambda, const ConstVectorRef& q) const;
  // The largest component of it at the start, N: of dead loads the largest load.
  double largest_load() const { return largest_load_; }
  const PathTimes& times() const { return times_; }
  bool moves_supports() const { return times_.begin != times_.end; }
  // Whether rate() is the same everywhere, and costs nothing.
  bool has_constant_rate() const { return !moves_supports() && !loads_; }

  int num_dofs() const override { return model_.num_dofs(); }
  const Ranks* ranks() const override { return model_.ranks(); }
  Eigen::Index num_dofs_of_all() const override { return model_.num_dofs_of_all(); }
  Vector part_of(const Vector& all) const override { return model_.part_of(all); }
  const Traits& traits() const override { return traits_; }
  void force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  const Pattern& pattern() const override { return model_.pattern(); }
  void combine(const Weights& w, const Linearization& at, double* values) const override {
    model_.combine(w, at, values);
  }
  void multiply_matrix(const double* values, const ConstVectorRef& x, VectorRef y) const override {
    model_.multiply_matrix(values, x, y);
  }
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { model_.multiply_mass(x, y); }
  void solve_mass(VectorRef x) const override { model_.solve_mass(x); }
  Eigen::MatrixXd rigid_motions(const ConstVectorRef& q) const override { return model_.rigid_motions(q); }

  std::vector<OutputInfo> outputs() const override { return model_.outputs(); }
  std::unique_ptr<StateView> view(const State& state) const override;
  Geometry geometry() const override { return model_.geometry(); }

 private:
  enum class Loaded { yes, no };
  LoadPath(const Model& model, const PathTimes& times, Vector start, Loaded loaded);

  void divide(Loaded loaded);
  void look_at_loads();
  void assemble(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;
  void assemble_mixed(double lambda_before, const ConstVectorRef& q_before, double lambda, const ConstVectorRef& q,
                      Linearization& out) const override;
  void add_load_tangent(double lambda, const ConstVectorRef& q, TangentKind kind, Linearization& out) const;
  const Model& structure() const { return structure_ ? *structure_ : model_; }

  const Model& model_;
  PathTimes times_;
  Traits traits_;
  Vector start_;
  std::unique_ptr<const Model> structure_;  // null where the model does not tell its loads
  std::unique_ptr<const Model> loads_;      // null where there are none, and where they are dead and constant
  bool loads_have_tangent_ = false;
  Vector dead_;        // force of loads that are dead and constant, N; empty where there are none
  Vector unbalanced_;  // force at the start that grows as a dead load, in place of loads, N; empty where there is none
  double largest_load_ = 0;
};

}  // namespace orthodyn
