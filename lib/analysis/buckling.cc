#include "lib/analysis/buckling.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/analysis/modes.h"
#include "lib/core/errors.h"
#include "lib/linear/negative_eigenpairs.h"
#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

constexpr double kStep = 1e-4;          // displacement step of the central difference, relative to the body's size
constexpr double kLargestStrain = 0.1;  // strain at the load-factor limit

using Values = std::vector<double>;  // entries of a matrix on the model's pattern

Values stiffness_at(const Model& model, double t, const Vector& q, TangentKind kind) {
  Linearization at;
  model.linearize(t, q, Vector::Zero(q.size()), kind, at);
  Values values(model.pattern().row.size());
  model.combine({0, 0, 1}, at, values.data());
  return values;
}

// Returns a A + b B.
Values sum(double a, const Values& A, double b, const Values& B) {
  Values out(A.size());
  for (std::size_t k = 0; k < A.size(); ++k) out[k] = a * A[k] + b * B[k];
  return out;
}

// The largest small-strain norm (Frobenius) of a displacement.
double largest_strain(const FemModel& model, double t, const Vector& u) {
  const NodalExpansion nodal(model.parts(), t, u, Vector::Zero(u.size()));
  double largest = 0;
  for (const auto& term : model.parts().elastic)
    for (int k = 0; k < term->size(); ++k)
      for (int p = 0; p < term->num_points(); ++p)
        largest = std::max(largest, term->small_strain(k, p, nodal.u).norm());
  return largest;
}

// Stress stiffness of the stresses at q: exact minus Gauss-Newton tangent.
Values stress_stiffness_at(const Model& structure, double t, const Vector& q) {
  return sum(1, stiffness_at(structure, t, q, TangentKind::exact), -1,
             stiffness_at(structure, t, q, TangentKind::gauss_newton));
}

// Stress stiffness of the linear response u about `unloaded`. The central difference cancels the second-order strains
// of a displacement along a straight line.
Values stress_stiffness(const Model& structure, double t, const Vector& unloaded, const Vector& u) {
  return sum(0.5, stress_stiffness_at(structure, t, unloaded + u), -0.5,
             stress_stiffness_at(structure, t, unloaded - u));
}

}  // namespace

BucklingModes buckling_modes(const FemModel& model, const Vector& unloaded, double t, int count) {
  const Pattern& pattern = model.pattern();
  if (!pattern.symmetric)
    throw ConfigError("buckling needs a symmetric tangent; remove elasticity.warped_tangent: unsymmetric");
  const auto structure = without_loads(model), loads = model.only(model.load_parts().value());
  const Values K = stiffness_at(*structure, t, unloaded, TangentKind::exact);
  const auto solver = make_linear_solver("cholesky", pattern);
  if (solver->factor(K.data()) != FactorStatus::ok)
    throw RunError("the stiffness without loads is not positive definite: the body is not held, or unstable");
  Vector f(unloaded.size()), u(unloaded.size());
  loads->force(t, unloaded, Vector::Zero(unloaded.size()), f);
  if (f.isZero(0)) throw RunError("no load acts on the body, so it has no critical load factor");
  solver->solve(f, u);
  // Scales u by `times`, so that the central difference is accurate for loads of any size.
  const double size = bounding_box(model.parts().mesh).size().maxCoeff();
  const double times = kStep * size / u.lpNorm<Eigen::Infinity>();
  u *= times;
  const Values rate = sum(1, stress_stiffness(*structure, t, unloaded, u), times,
                          stiffness_at(*loads, t, unloaded, TangentKind::exact));
  const double smallest = largest_strain(model, t, u) / kLargestStrain;
  // The eigenvalues are -times / lambda.
  const NegativeEigenPairs pairs = negative_eigenpairs(pattern, rate, K, smallest, count);
  BucklingModes out{{}, times / smallest};
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    BucklingMode mode{-times / pairs.values[k], pairs.shapes.col(k)};
    fix_sign(mode.shape);
    Vector stressed(u.size()), missing(u.size()), elastic(u.size());
    pattern.multiply(rate.data(), mode.shape, stressed);
    solver->solve(stressed, missing);
    missing = mode.shape + mode.load_factor / times * missing;
    pattern.multiply(K.data(), missing, elastic);
    mode.residual = std::sqrt(std::max(missing.dot(elastic), 0.0));
    out.modes.push_back(std::move(mode));
  }
  return out;
}

}  // namespace orthodyn
