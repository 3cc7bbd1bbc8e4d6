#include "lib/analysis/displacement_error.h"

#include <memory>

#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

std::unique_ptr<LinearSolver> factorised_tangent(const FemModel& model, const State& s) {
  Linearization at;
  model.linearize(s.t, s.q, s.v, TangentKind::exact, at);
  std::vector<double> values(at.stiffness.size());
  model.combine({0, 0, 1}, at, values.data());
  auto solver = make_solver_for(model.pattern());
  if (solver->factor(values.data()) != FactorStatus::ok)
    throw RunError("the tangent at the equilibrium cannot be factorised: it is singular or unstable");
  return solver;
}

}  // namespace

std::vector<Vec3> displacement_errors(const FemModel& model, const State& equilibrium, const std::vector<int>& nodes) {
  const FemModel::Parts& parts = model.parts();
  const StressRecovery& recovery = *parts.recovery;
  const NodalExpansion nodal(parts, equilibrium.t, equilibrium.q, Vector::Zero(equilibrium.q.size()));
  const StressMisfit primal = recovery.misfit(nodal.state());
  const auto solver = factorised_tangent(model, equilibrium);
  Vector unit(model.num_dofs()), response(model.num_dofs());
  std::vector<Vec3> errors;
  for (const int node : nodes) {
    Vec3 error = Vec3::Zero();
    for (int component = 0; component < 3; ++component) {
      NodalVector force = NodalVector::Zero(3, nodal.x.cols()), dual = force;
      force(component, node) = 1;
      parts.dofs->restrict_to(force, unit);
      if (unit.isZero(0)) continue;
      solver->solve(unit, response);
      parts.dofs->add_to(response, dual);
      error[component] = recovery.product(primal, recovery.misfit_along(dual, nodal.state()));
    }
    errors.push_back(error);
  }
  return errors;
}

}  // namespace orthodyn
