// A model with internal variables (internal_variables.h) as a Model whose force and K are those at a known state of
// these variables. Unlike other models it changes between evaluations, by functions of the derived classes. Not
// thread-safe.
#pragma once

#include <string>
#include <vector>

#include "lib/ode/derived_model.h"
#include "lib/ode/internal_variables.h"

namespace orthodyn {

class InternalModel : public DerivedModel {
 public:
  // `model` has internal variables and must outlive this object.
  explicit InternalModel(const Model& model)
      : DerivedModel(model), internal_(*model.internal_variables()), traits_(model.traits()) {
    traits_.linear = false;  // K depends on the state of the internal variables
  }

  const InternalVariables& internal() const { return internal_; }

  const Traits& traits() const override { return traits_; }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    internal_.force(t, q, v, internal_at(t), f);
  }
  const Constraints* constraints() const override { return original().constraints(); }
  double frequency_bound() const override { return original().frequency_bound(); }
  std::vector<double> breakpoints(double start, double end) const override {
    return original().breakpoints(start, end);
  }
  StepLimits step_limits(double start, double end) const override { return original().step_limits(start, end); }
  std::vector<OutputInfo> outputs() const override { return original().outputs(); }
  std::unique_ptr<StateView> view(const State& state) const override { return original().view(state); }
  Geometry geometry() const override { return original().geometry(); }

 private:
  virtual InternalState internal_at(double t) const = 0;

  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    internal_.assemble(t, q, v, internal_at(t), kind, out);
  }

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
