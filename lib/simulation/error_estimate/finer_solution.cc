#include "lib/simulation/error_estimate/finer_solution.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/analysis/rigid_freedom.h"
#include "lib/core/errors.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/fem/element_mesh.h"
#include "lib/linear/two_level.h"

namespace orthodyn {

namespace {

constexpr double kAccuracy = 0.02;  // relative accuracy of the correction's energy
constexpr int kMaxIterations = 300;
constexpr double kFreeShift = 1e-10;  // shift over the largest squared frequency, for free bodies

// Ratio of the energy of the whole error to the part that finer elements resolve. This energy is proportional to h^p
// with the cell size h and p from 1 (edges, corners) to 4 (smooth solution, quadratic elements), so that halving h
// resolves 1/2 to 15/16 of it; 3/4 is assumed. Replacing linear elements by quadratic ones resolves nearly all.
double extrapolation(int order) { return order == 1 ? 1 : 4.0 / 3; }

// Values of K and of K + shift M on a model's pattern.
struct Matrices {
  std::vector<double> stiffness, shifted;
};

Matrices matrices(const FemModel& whole, const State& about, double shift, TangentKind kind) {
  const auto unloaded = about.load_factor == 0 ? without_loads(whole) : nullptr;
  const Model& model = unloaded ? *unloaded : static_cast<const Model&>(whole);
  Linearization at;
  model.linearize(about.t, about.q, Vector::Zero(about.q.size()), kind, at);
  Matrices out{std::vector<double>(at.stiffness.size()), std::vector<double>(at.stiffness.size())};
  model.combine({0, 0, 1}, at, out.stiffness.data());
  model.combine({shift, 0, 1}, at, out.shifted.data());
  return out;
}

// Solves (K + s M) x = b for the finer model at a coarse state; s is the shift, and K the tangent of this kind. If the
// elements are not nested, the matrix is factorised. The accuracy of the two-level iteration is relative to the energy
// of x, which then contains energy_of_lift(): the iteration would stop too early.
class FinerSystem {
 public:
  FinerSystem(const FinerModel& finer, const State& coarse, double shift, TangentKind kind)
      : finer_(finer), q_(finer.state_of(coarse.t, coarse.q)) {
    const FemModel& model = finer.coarse();
    if (!model.pattern().symmetric || !finer.model().pattern().symmetric)
      throw RunError("the tangent is not symmetric");
    values_ = matrices(finer.model(), {coarse.t, q_, {}, coarse.load_factor}, shift, kind);
    if (!is_nested(model)) {
      direct_ = make_solver_for(finer.model().pattern());
      if (direct_->factor(values_.shifted.data()) != FactorStatus::ok)
        throw RunError("the tangent of the finer elements cannot be factorised");
      return;
    }
    coarse_values_ = matrices(model, coarse, shift, kind).shifted;
    coarse_ = make_solver_for(model.pattern());
    coarse_->set_tolerance({kAccuracy, 0});
    if (coarse_->factor(coarse_values_.data()) != FactorStatus::ok)
      throw RunError("the tangent cannot be factorised: it is singular or unstable");
    solver_ =
        std::make_unique<TwoLevelSolver>(finer.model().pattern(), values_.shifted, [this](const ConstVectorRef& b) {
          Vector x = finer_.lower(b);
          coarse_->solve(x, x);
          return finer_.lift(x);
        });
  }

  // One solution for each column of b.
  std::vector<TwoLevelSolver::Solution> solve(const Eigen::MatrixXd& b) const {
    if (direct_) {
      std::vector<TwoLevelSolver::Solution> all;
      for (Eigen::Index k = 0; k < b.cols(); ++k) {
        Vector x(b.rows());
        direct_->solve(Vector(b.col(k)), x);
        all.push_back({x, x.dot(b.col(k)), 0, true});
      }
      return all;
    }
    return solver_->solve(b, kAccuracy, kMaxIterations);
  }
  Vector stiffness_times(const Vector& x) const {
    Vector y(x.size());
    finer_.model().pattern().multiply(values_.stiffness.data(), x, y);
    return y;
  }
  const Vector& q() const { return q_; }

 private:
  const FinerModel& finer_;
  Vector q_;
  std::vector<double> coarse_values_;
  std::unique_ptr<LinearSolver> coarse_;
  Matrices values_;
  std::unique_ptr<TwoLevelSolver> solver_;
  std::unique_ptr<LinearSolver> direct_;  // if the elements are not nested
};

// At the coarse displacement q, lifted to the finer elements: their elastic energy minus the energy of the coarse
// elements, J. Zero if the elements are nested.
double energy_of_lift(const FinerModel& finer, const State& coarse, const Vector& q) {
  if (is_nested(finer.coarse())) return 0;
  const Vector still = Vector::Zero(q.size());
  return finer.model().evaluate("energy.elastic", {coarse.t, q, still, coarse.load_factor})[0] -
         finer.coarse().evaluate("energy.elastic", coarse)[0];
}

// Acceleration with the consistent mass, with which forces that the coarse elements resolve leave no residual in the
// finer elements.
Vector acceleration(const FemModel& model, const State& s) {
  const FemModel::Parts& parts = model.parts();
  Vector a(s.q.size());
  model.force(s.t, s.q, s.v, a);
  if (!parts.mass->lumped()) {
    parts.mass->solve(a);
    return a;
  }
  std::vector<double> density(parts.mesh.cells.size());
  for (std::size_t r = 0; r < parts.elastic.size(); ++r)
    for (int k = 0; k < parts.elastic[r]->size(); ++k)
      density[static_cast<std::size_t>(parts.elastic[r]->cell(k))] = parts.densities[r];
  Mass(MassKind::consistent, ElementMesh(parts.mesh), density, *parts.dofs, *parts.pattern).solve(a);
  return a;
}

Vector mass_times(const FemModel& model, const Vector& x) {
  Vector y(x.size());
  model.multiply_mass(x, y);
  return y;
}

// Values of an output, one column per node. The finer mesh contains the nodes of the coarse mesh first, in the same
// order.
Eigen::MatrixXd nodal_values(const FemModel& model, const std::string& field, const State& state) {
  const auto values = model.evaluate(field, state);
  const auto nodes = static_cast<Eigen::Index>(model.parts().mesh.nodes.size());
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), std::ssize(values) / nodes, nodes);
}

// Errors of one field at `nodes`: differences between coarse and finer elements, extrapolated.
std::vector<FieldError> field_errors(const FinerModel& finer, const State& coarse, const State& fine,
                                     const std::string& field, const std::vector<int>& nodes) {
  constexpr double kOfLargest = 0.1;
  const Eigen::MatrixXd before = nodal_values(finer.coarse(), field, coarse);
  const Eigen::MatrixXd after = nodal_values(finer.model(), field, fine);
  double largest = 0;
  for (Eigen::Index k = 0; k < before.cols(); ++k)
    if (before.col(k).allFinite()) largest = std::max(largest, before.col(k).norm());
  std::vector<FieldError> out;
  for (const int node : nodes)
    out.push_back({std::max(before.col(node).norm(), kOfLargest * largest),
                   extrapolation(finer.coarse().parts().mesh.order()) * (after.col(node) - before.col(node)).norm()});
  return out;
}

// A shift s for which K + s M is positive definite.
double shift_for(const Modes& modes) {
  const double lowest = modes.modes.front().lambda;
  if (modes.zeros == 0 && lowest > 0) return 0;
  for (const Mode& mode : modes.modes)
    if (mode.lambda > 0) return lowest < 0 ? mode.lambda - 2 * lowest : mode.lambda;
  return -2 * lowest;
}

// K and M restricted to a few vectors (Rayleigh-Ritz).
class Subspace {
 public:
  Subspace(const FinerSystem& system, const FemModel& model, Eigen::Index size)
      : system_(system), model_(model), V_(model.num_dofs(), size), KV_(V_.rows(), size), MV_(V_.rows(), size) {}

  void add(const Vector& v) {
    V_.col(count_) = v / v.norm();
    KV_.col(count_) = system_.stiffness_times(V_.col(count_));
    MV_.col(count_) = mass_times(model_, V_.col(count_));
    ++count_;
  }
  // Rayleigh-Ritz values lambda, ascending. Precondition: K + s M is positive definite, with s = `shift`. A dense
  // solver makes an error proportional to the largest eigenvalue. For K phi = lambda M phi with many modes that error
  // would exceed the lowest lambda. The inverse problem M phi = mu (K + s M) phi has its largest mu = 1/(lambda + s) at
  // the lowest lambda, which is therefore accurate.
  Vector eigenvalues(double shift) const {
    const auto V = V_.leftCols(count_);
    const Eigen::MatrixXd M = V.transpose() * MV_.leftCols(count_);
    const Eigen::MatrixXd K = V.transpose() * KV_.leftCols(count_) + shift * M;
    const Vector scale = K.diagonal().cwiseSqrt().cwiseInverse();
    const Vector inverse =
        symmetric_eigenvalues(scale.asDiagonal() * M * scale.asDiagonal(), scale.asDiagonal() * K * scale.asDiagonal());
    return inverse.reverse().cwiseInverse().array() - shift;
  }

 private:
  const FinerSystem& system_;
  const FemModel& model_;
  Eigen::MatrixXd V_, KV_, MV_;
  Eigen::Index count_ = 0;
};

}  // namespace

StateError state_error(const FinerModel& finer, const State& coarse, bool in_motion, const std::vector<int>& nodes,
                       const NodesByField& fields) {
  const FemModel& fine = finer.model();
  const bool is_free = count_rigid_freedom(finer.coarse(), coarse.t) > 0;
  const double fastest = finer.coarse().frequency_bound();
  // The lifted displacement of mixed elements changes the volumes of the finer ones: their pressures are too large by
  // far, and with them the second derivatives in the exact tangent.
  const TangentKind kind = is_mixed(finer.coarse()) ? TangentKind::gauss_newton : TangentKind::exact;
  const FinerSystem system(finer, coarse, is_free ? kFreeShift * fastest * fastest : 0, kind);
  Vector force(fine.num_dofs());
  fine.force(coarse.t, system.q(), in_motion ? finer.lift(coarse.v) : Vector(Vector::Zero(force.size())), force);
  if (in_motion) force -= mass_times(fine, finer.lift(acceleration(finer.coarse(), coarse)));
  const auto found = system.solve(force).front();
  const int order = finer.coarse().parts().mesh.order();
  NodalVector correction = NodalVector::Zero(3, static_cast<Eigen::Index>(fine.parts().mesh.nodes.size()));
  fine.parts().dofs->add_to(found.x, correction);
  const double energy = std::abs(0.5 * found.energy - energy_of_lift(finer, coarse, system.q()));
  StateError out{extrapolation(order) * energy, {}, {}};
  for (const int node : nodes) out.displacements.emplace_back(extrapolation(order) * correction.col(node));
  const State closer{coarse.t, system.q() + found.x, Vector::Zero(force.size()), coarse.load_factor};
  for (const auto& [field, at] : fields) {
    try {
      out.fields[field] = field_errors(finer, coarse, closer, field, at);
    } catch (const RecoverableError&) {  // no values in the finer elements
    }
  }
  return out;
}

std::vector<double> frequency_errors(const FinerModel& finer, const State& about, const Modes& modes) {
  std::vector<double> errors(modes.modes.size(), 0);
  const auto zeros = static_cast<std::size_t>(modes.zeros);
  if (zeros == errors.size()) return errors;
  // Also of mixed elements: frequencies about a loaded state depend on the part of the tangent that Gauss-Newton lacks.
  const double shift = shift_for(modes);
  const FinerSystem system(finer, about, shift, TangentKind::exact);
  Subspace space(system, finer.model(), static_cast<Eigen::Index>(2 * errors.size() - zeros));
  Eigen::MatrixXd residuals(finer.model().num_dofs(), static_cast<Eigen::Index>(errors.size() - zeros));
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const Mode& mode = modes.modes[k];
    const Vector shape = finer.lift(mode.shape);
    space.add(shape);
    if (k < zeros) continue;
    residuals.col(static_cast<Eigen::Index>(k - zeros)) =
        mode.lambda * mass_times(finer.model(), shape) - system.stiffness_times(shape);
  }
  for (const auto& correction : system.solve(residuals))
    if (correction.energy > 0) space.add(correction.x);
  const Vector finer_values = space.eigenvalues(shift);
  const double more = extrapolation(finer.coarse().parts().mesh.order());
  for (std::size_t k = zeros; k < errors.size(); ++k) {
    // Extrapolates the compliance 1/lambda, because errors of compliances add like energies.
    const double excess = modes.modes[k].lambda / finer_values[static_cast<Eigen::Index>(k)] - 1;
    errors[k] = std::sqrt(std::max(1 + more * excess, 0.0)) - 1;
  }
  return errors;
}

}  // namespace orthodyn
