// A body at rest while its loads grow, as a model whose time is the load factor lambda in [0, 1]:
//
//     f_lambda(q) = f(t, q, 0) - (1 - lambda) f(t, q0, 0)
//
// At 0 the starting shape q0 is in equilibrium, at 1 all of f acts. Dead loads on a stress-free shape thus
// grow in proportion to lambda; of all else (follower loads, prestress, moved boundaries) what is out of
// balance in q0 does. The stiffness is the model's own. Functions of time are taken at t.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/ode/model.h"

namespace orthodyn {

class LoadPath : public Model {
 public:
  // t in s, start: q0, m. `model` must outlive it. Throws RecoverableError where it has no force.
  LoadPath(const Model& model, double t, Vector start);

  const Vector& start() const { return start_; }
  const Vector& load() const { return load_; }  // f(t, q0, 0), N
  double time() const { return t_; }

  int num_dofs() const override { return model_.num_dofs(); }
  const Traits& traits() const override { return model_.traits(); }
  void force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  const Pattern& pattern() const override { return model_.pattern(); }
  void combine(const Weights& w, const Linearization& at, double* values) const override {
    model_.combine(w, at, values);
  }
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { model_.multiply_mass(x, y); }
  void solve_mass(VectorRef x) const override { model_.solve_mass(x); }

  std::vector<OutputInfo> outputs() const override { return model_.outputs(); }
  std::unique_ptr<StateView> view(const State& state) const override { return model_.view({t_, state.q, state.v}); }
  Geometry geometry() const override { return model_.geometry(); }

 private:
  void assemble(double, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    model_.linearize(t_, q, v, kind, out);
  }
  void assemble_mixed(double, const ConstVectorRef& q_before, const ConstVectorRef& q,
                      Linearization& out) const override {
    model_.linearize_mixed(t_, q_before, q, out);
  }

  const Model& model_;
  double t_;
  Vector start_, load_;
};

}  // namespace orthodyn
