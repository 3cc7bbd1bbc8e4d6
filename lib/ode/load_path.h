// A body at rest while its loads grow, as a model whose time is the load factor lambda in [0, 1]:
//
//     f_lambda(q) = f(t, q, 0) - (1 - lambda) f(t_0, q0, 0),  t = t_0 + lambda (t_1 - t_0)
//
// At 0 the starting shape q0 is in equilibrium, at 1 all of f acts. Dead loads on a stress-free shape thus
// grow in proportion to lambda; of all else (follower loads, prestress) what is out of balance in q0 does. Supports may
// move from t_0 to t_1. The stiffness is the model's own.
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
  // start: q0, m. `model` must outlive it. Throws RunError where it has no force.
  LoadPath(const Model& model, const PathTimes& times, Vector start);

  const Vector& start() const { return start_; }
  // df_lambda/dlambda, N; beyond [0, 1], where supports stand still, that at the nearer end. Throws RecoverableError
  // where the model does.
  Vector rate(double lambda, const ConstVectorRef& q) const;
  // The largest component of it at the start, N: of dead loads the largest load.
  double largest_load() const { return largest_load_; }
  const PathTimes& times() const { return times_; }
  bool moves_supports() const { return times_.begin != times_.end; }

  int num_dofs() const override { return model_.num_dofs(); }
  const Ranks* ranks() const override { return model_.ranks(); }
  Eigen::Index num_dofs_of_all() const override { return model_.num_dofs_of_all(); }
  Vector part_of(const Vector& all) const override { return model_.part_of(all); }
  const Traits& traits() const override { return model_.traits(); }
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
  std::unique_ptr<StateView> view(const State& state) const override {
    return model_.view({times_.at(state.t), state.q, state.v});
  }
  Geometry geometry() const override { return model_.geometry(); }

 private:
  void assemble(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    model_.linearize(times_.at(lambda), q, v, kind, out);
  }
  void assemble_mixed(double lambda_before, const ConstVectorRef& q_before, double lambda, const ConstVectorRef& q,
                      Linearization& out) const override {
    model_.linearize_mixed(times_.at(lambda_before), q_before, times_.at(lambda), q, out);
  }

  const Model& model_;
  PathTimes times_;
  Vector start_, load_;  // load: f(t_0, q0, 0), N
  double largest_load_ = 0;
};

}  // namespace orthodyn
