#include "lib/analysis/displacement_error.h"

#include <memory>
#include <string>

#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

constexpr double kSolveTolerance = 1e-4;  // relative, in the energy norm; for iterative solvers

std::unique_ptr<LinearSolver> factorised_tangent(const FemModel& model, const State& s) {
  Linearization at;
  model.linearize(s.t, s.q, s.v, TangentKind::exact, at);
  std::vector<double> values(at.stiffness.size());
  model.combine({0, 0, 1}, at, values.data());
  auto solver = make_linear_solver({model.pattern().symmetric ? "auto" : "klu"}, model.pattern());
  if (solver->is_iterative()) {
    solver->set_tolerance({kSolveTolerance, 0});
    solver->set_rigid_motions(model.rigid_motions(s.q));
  }
  if (solver->factor(values.data()) != FactorStatus::ok)
    throw RunError("the tangent at the equilibrium cannot be factorised: it is singular or unstable");
  return solver;
}

std::vector<Vec3> errors_by_duals(const FemModel& model, const State& equilibrium, const std::vector<int>& nodes) {
  const FemModel::Parts& parts = model.parts();
  const StressRecovery& recovery = *parts.recovery;
  const NodalExpansion nodal(parts, equilibrium.t, equilibrium.q, Vector::Zero(equilibrium.q.size()));
  const StressMisfit primal = recovery.misfit(nodal.state());
  const auto solver = factorised_tangent(model, equilibrium);
  Vector unit(model.num_dofs()), response(model.num_dofs());
  std::vector<Vec3> errors;
  for (const int node : nodes) {
    const int here = parts.subdomain ? parts.subdomain->local(node) : node;
    Vec3 error = Vec3::Zero();
    for (int component = 0; component < 3; ++component) {
      NodalVector force = NodalVector::Zero(3, nodal.x.cols()), dual = force;
      if (here >= 0) force(component, here) = 1;
      parts.dofs->restrict_forces_to(force, unit);
      if (model.space().is_zero(unit)) continue;
      solver->solve(unit, response);
      parts.dofs->add_to(response, dual);
      if (parts.subdomain) parts.subdomain->copy_from_owners(dual);
      error[component] = recovery.product(primal, recovery.misfit_along(dual, nodal.state()));
    }
    errors.push_back(error);
  }
  return errors;
}

}  // namespace

std::vector<Vec3> displacement_errors(const FemModel& model, const State& equilibrium, const std::vector<int>& nodes) {
  try {
    return errors_by_duals(model, equilibrium, nodes);
  } catch (const RecoverableError& e) {
    throw RunError(std::string("the error of displacements is not known: ") + e.what());
  }
}

}  // namespace orthodyn
