#include "lib/analysis/static_response.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/errors.h"
#include "lib/linear/solver.h"
#include "lib/ode/internal_variables.h"

namespace orthodyn {

namespace {

constexpr int kLargestForVelocities = 30'000;  // largest number of unknowns if only initial velocities need the factor

// Sum of the peak forces (N) of `count` terms of Parts::loads, starting with term `first`.
Vector peak_load(const FemModel& model, const State& initial, double end, std::size_t first, std::size_t count) {
  const Vector still = Vector::Zero(model.num_dofs());
  const NodalExpansion nodal(model.parts(), initial.t, initial.q, still);
  NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
  for (std::size_t k = first; k < first + count; ++k) model.parts().loads[k]->add_peak_force(nodal.state(), end, sum);
  if (model.parts().subdomain) model.parts().subdomain->add_to_owners(sum);
  Vector free(model.num_dofs());
  model.parts().dofs->restrict_forces_to(sum, free);
  return free;
}

// Sum of the impulses of all loads in the directions of their peaks, N s.
Vector impulse(const FemModel& model, const State& initial, double end) {
  Vector sum = Vector::Zero(model.num_dofs());
  for (std::size_t k = 0; k < model.parts().loads.size(); ++k)
    sum += model.parts().loads[k]->seconds_at_peak(initial.t, end) * peak_load(model, initial, end, k, 1);
  return sum;
}

constexpr double kAccuracy = 1e-5;  // relative, in the energy norm; for iterative solvers

// Factorises K at rest at the time t, with `duration` (s) that of viscoelastic materials after a strain that has grown
// for this time, and stores its entries in `values`. Returns null if K is singular or nearly so, or if the factor does
// not fit into memory, because runs that need no factor can go on.
std::unique_ptr<LinearSolver> factored_stiffness(const FemModel& model, std::vector<double>& values, double t = 0,
                                                 std::optional<double> duration = {}) try {
  const Vector zero = Vector::Zero(model.num_dofs());
  Linearization at;
  if (const InternalVariables* internal = model.internal_variables(); internal && duration)
    internal->assemble(t, zero, zero, {InternalState::Kind::history, nullptr, *duration}, TangentKind::gauss_newton,
                       at);
  else model.linearize(0, zero, zero, TangentKind::gauss_newton, at);
  values.resize(at.stiffness.size());
  model.combine({0, 0, 1}, at, values.data());
  auto solver = make_linear_solver({model.pattern().symmetric ? "auto" : "klu"}, model.pattern());
  if (solver->is_iterative()) {
    solver->set_tolerance({kAccuracy, 0});
    solver->set_rigid_motions(model.rigid_motions(zero));
  }
  return solver->factor(values.data()) == FactorStatus::ok ? std::move(solver) : nullptr;
} catch (const RunError& e) {
  if (e.reason() == Reason::out_of_memory) return nullptr;
  throw;
}

// Solves K x = b. Returns nullopt if round-off dominates x or an iterative solver does not converge.
std::optional<Vector> solution(LinearSolver& solver, const FemModel& model, const std::vector<double>& values,
                               const Vector& b) try {
  const VectorSpace space = model.space();
  Vector x(b.size()), Kx(b.size());
  solver.solve(b, x);
  model.multiply_matrix(values.data(), x, Kx);
  if (!space.is_finite(x)) return std::nullopt;
  // An iterative solver has already checked the error, which may be small although the residual is large.
  if (solver.is_iterative() || space.norm(Kx - b) <= 1e-3 * space.norm(b)) return x;
  return std::nullopt;
} catch (const RecoverableError&) {  // the iterative solver did not converge
  return std::nullopt;
}

}  // namespace

std::vector<Vector> peak_loads(const FemModel& model, const State& initial, double end) {
  const auto& loads = model.parts().loads;
  std::vector<Vector> out;
  for (std::size_t k = 0; k < loads.size(); ++k) out.push_back(peak_load(model, initial, end, k, 1));
  return out;
}

std::vector<Vector> static_displacements(const FemModel& model, const std::vector<Vector>& loads) {
  std::vector<double> values;
  const auto solver = factored_stiffness(model, values);
  std::vector<Vector> out;
  for (const Vector& load : loads)
    out.push_back(solver ? solution(*solver, model, values, load).value_or(Vector()) : Vector());
  return out;
}

double load_duration_factor(const VectorSpace& space, const StaticResponse& statics) {
  const double deflection = space.largest_entry(statics.displacement);
  return deflection > 0 ? std::min(1.0, 1.5 * statics.impulse_amplitude / deflection) : 1;
}

StaticResponse static_response(const FemModel& model, const State& initial, double end) {
  StaticResponse response{peak_load(model, initial, end, 0, model.parts().loads.size()), {}};
  const bool is_motion = !model.parts().loads_at && end > initial.t;
  if (const InternalVariables* internal = model.internal_variables(); internal && is_motion)
    internal->add_peak_force(initial.t, end, response.load);
  const Vector& load = response.load;
  Vector momentum(load.size());
  model.multiply_mass(initial.v, momentum);
  // Without loads, a factorisation is worthwhile only for initial velocities of a held body that is not too large.
  const VectorSpace space = model.space();
  const Eigen::Index unknowns = model.num_dofs_of_all();
  const auto tied = std::ssize(model.parts().dofs->ties().nodes());
  const bool is_free = unknowns == 3 * (std::ssize(model.parts().mesh.nodes) - tied);
  if (space.is_zero(load) && (space.is_zero(momentum) || is_free || unknowns > kLargestForVelocities)) return response;
  std::vector<double> values;
  const auto solver =
      factored_stiffness(model, values, initial.t, is_motion ? std::optional(end - initial.t) : std::nullopt);
  if (!solver) return response;
  const auto solve = [&](const Vector& b) { return solution(*solver, model, values, b); };
  std::optional<Vector> u = solve(load);
  const std::optional<Vector> w = solve(momentum);
  if (!u || !w) return response;
  response.work = space.dot(*u, load);
  response.displacement = std::move(*u);
  response.known = true;
  // An M-normalised mode with angular frequency omega and initial velocity v reaches the amplitude v / omega. The sum
  // of v^2 / omega^2 over all modes is p^T K^-1 p with the initial momentum p.
  const auto amplitude = [&](const Vector& p, const Vector& response_to_p) {
    return std::sqrt(std::max(space.dot(response_to_p, p), 0.0) / model.parts().mass->total());
  };
  response.velocity_amplitude = amplitude(momentum, *w);
  const Vector blow = impulse(model, initial, end);
  const std::optional<Vector> after = solve(blow);
  response.impulse_amplitude = after ? amplitude(blow, *after) : std::numeric_limits<double>::infinity();
  return response;
}

}  // namespace orthodyn
