// A model with internal variables (internal_variables.h) as a Model whose force and K are those at a known state of
// these variables. Unlike other models it changes between evaluations, by functions of the derived classes. Not
// thread-safe.
#pragma once

#include <string>
#include <vector>

#include "lib/ode/internal_variables.h"
#include "lib/ode/model.h"

namespace orthodyn {

class InternalModel : public Model {
 public:
  // `model` has internal variables and must outlive this object.
  explicit InternalModel(const Model& model)
      : model_(model), internal_(*model.internal_variables()), traits_(model.traits()) {
    traits_.linear = false;  // K depends on the state of the internal variables
  }

  const InternalVariables& internal() const { return internal_; }

  int num_dofs() const override { return model_.num_dofs(); }
  const Ranks* ranks() const override { return model_.ranks(); }
  Eigen::Index num_dofs_of_all() const override { return model_.num_dofs_of_all(); }
  Vector part_of(const Vector& all) const override { return model_.part_of(all); }
  const Traits& traits() const override { return traits_; }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    internal_.force(t, q, v, internal_at(t), f);
  }
  const Constraints* constraints() const override { return model_.constraints(); }
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
  double frequency_bound() const override { return model_.frequency_bound(); }
  std::vector<double> breakpoints(double start, double end) const override { return model_.breakpoints(start, end); }
  StepLimits step_limits(double start, double end) const override { return model_.step_limits(start, end); }
  std::vector<OutputInfo> outputs() const override { return model_.outputs(); }
  std::unique_ptr<StateView> view(const State& state) const override { return model_.view(state); }
  Geometry geometry() const override { return model_.geometry(); }

 private:
  virtual InternalState internal_at(double t) const = 0;

  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    internal_.assemble(t, q, v, internal_at(t), kind, out);
  }

  const Model& model_;
  const InternalVariables& internal_;
  Traits traits_;
};

// The internal variables of a state: z, or their equilibrium if z is empty.
inline Vector internals_of(const InternalVariables& internal, double t, const Vector& q, const Vector& z) {
  if (z.size() > 0) return z;
  Vector e(internal.size());
  internal.strains(t, q, e);
  return e;
}

// With given internal variables.
class GivenInternalModel final : public InternalModel {
 public:
  using InternalModel::InternalModel;
  // `z` must outlive its use. gamma: of Newton's method, for K (InternalState::time).
  void set(const double* z, double gamma = 0) { z_ = {InternalState::Kind::given, z, gamma}; }

 private:
  InternalState internal_at(double) const override { return z_; }

  InternalState z_;
};

}  // namespace orthodyn
