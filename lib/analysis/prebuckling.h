// The linear state before buckling, and the stiffness that loads add to it (buckling.h).
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/linear/solver.h"

namespace orthodyn {

// Entries of a matrix on the model's pattern.
using MatrixValues = std::vector<double>;

// The linear response to all loads, times a factor that makes it small.
struct SmallResponse {
  Vector u;          // m
  double times = 0;  // u = times K^-1 f, with the loads f
};

// Returns `times` K_g: the stress stiffness of the displacement `response.u`, and `times` the stiffness of the loads.
// `unloaded`: displacements without loads, m.
MatrixValues small_load_stiffness(const FemModel& model, double t, const Vector& unloaded,
                                  const SmallResponse& response);

class Prebuckling {
 public:
  // Computes K, its factor and the response to the loads at time t (s). `model` must outlive this object. Throws
  // ConfigError for an unsymmetric tangent; RunError if the body is not held or is unstable, or if it has no loads.
  Prebuckling(const FemModel& model, const Vector& unloaded, double t);

  const MatrixValues& stiffness() const { return stiffness_; }  // K of the unloaded structure
  LinearSolver& solver() const { return *solver_; }             // of K
  const SmallResponse& response() const { return response_; }

 private:
  MatrixValues stiffness_;
  std::unique_ptr<LinearSolver> solver_;
  SmallResponse response_;
};

}  // namespace orthodyn
