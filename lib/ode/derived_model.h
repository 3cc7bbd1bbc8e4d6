// A model with the unknowns, the mass and the matrices of another model, and another force.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

class DerivedModel : public Model {
 public:
  // `original` must outlive this object.
  explicit DerivedModel(const Model& original) : original_(original) {}

  int num_dofs() const override { return original_.num_dofs(); }
  const Ranks* ranks() const override { return original_.ranks(); }
  Eigen::Index num_dofs_of_all() const override { return original_.num_dofs_of_all(); }
  Vector part_of(const Vector& all) const override { return original_.part_of(all); }
  const Pattern& pattern() const override { return original_.pattern(); }
  void combine(const Weights& w, const Linearization& at, double* values) const override {
    original_.combine(w, at, values);
  }
  void multiply_matrix(const double* values, const ConstVectorRef& x, VectorRef y) const override {
    original_.multiply_matrix(values, x, y);
  }
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { original_.multiply_mass(x, y); }
  void solve_mass(VectorRef x) const override { original_.solve_mass(x); }
  Eigen::MatrixXd rigid_motions(const ConstVectorRef& q) const override { return original_.rigid_motions(q); }
  double longest_step(const State& state) const override { return original_.longest_step(state); }
  Angles angles(const State& state) const override { return original_.angles(state); }

 protected:
  const Model& original() const { return original_; }

 private:
  const Model& original_;
};

}  // namespace orthodyn
