// A Model whose force and tangent are Python functions.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <exception>

#include "lib/ode/model.h"

namespace orthodyn::python {

struct PythonModelParts {
  Vector mass;               // kg, of each coordinate
  pybind11::function force;  // f(t, q, v), N
  pybind11::object tangent;  // (t, q, v) -> (K, D), values on the pattern
  Pattern pattern;           // lower triangle only if symmetric
  bool damped = false;       // D is read; otherwise it may be None
  bool linear = false, time_dependent = true;
};

// Precondition of all calls: the interpreter's lock is held. A Python function requests a smaller step by raising
// RecoverableError; any other exception ends the run.
class PythonModel : public Model {
 public:
  explicit PythonModel(PythonModelParts parts);

  int num_dofs() const override { return parts_.pattern.n; }
  const Traits& traits() const override { return traits_; }
  const Pattern& pattern() const override { return parts_.pattern; }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  void combine(const Weights& w, const Linearization& at, double* values) const override;
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { y = parts_.mass.cwiseProduct(x); }
  void solve_mass(VectorRef x) const override { x = x.cwiseQuotient(parts_.mass); }

  // Throws the exception of a Python function, if there was one, because integrators keep only its message.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;

  template <class Call>
  pybind11::object called(Call&& call) const;

  PythonModelParts parts_;
  mutable std::exception_ptr thrown_;
  Traits traits_;
  std::vector<std::size_t> diagonal_;  // index of each column's diagonal entry
};

}  // namespace orthodyn::python
