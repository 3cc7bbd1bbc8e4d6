#include "lib/analysis/static_response.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"
#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

constexpr int kLargestForVelocities = 30'000;  // unknowns

// Of `count` terms of load from the given one.
Vector peak_load(const FemModel& model, const State& initial, double end, std::size_t first, std::size_t count) {
  const Vector still = Vector::Zero(model.num_dofs());
  const NodalExpansion nodal(model.parts(), initial.t, initial.q, still);
  NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
  for (std::size_t k = first; k < first + count; ++k)
    model.parts().loads[k]->add_peak_force(nodal.state(), end, sum);
  Vector free(model.num_dofs());
  model.parts().dofs->restrict_to(sum, free);
  return free;
}

// N s, of all loads in the direction of their peaks.
Vector impulse(const FemModel& model, const State& initial, double end) {
  Vector sum = Vector::Zero(model.num_dofs());
  for (std::size_t k = 0; k < model.parts().loads.size(); ++k)
    sum += model.parts().loads[k]->seconds_at_peak(initial.t, end) * peak_load(model, initial, end, k, 1);
  return sum;
}

// K at rest, factored; null where it is singular or nearly so, or does not fit: who needs no factor is to run.
std::unique_ptr<LinearSolver> factored_stiffness(const FemModel& model, std::vector<double>& values) try {
  const Vector zero = Vector::Zero(model.num_dofs());
  Linearization at;
  model.linearize(0, zero, zero, TangentKind::gauss_newton, at);
  values.resize(at.stiffness.size());
  model.combine({0, 0, 1}, at, values.data());
  auto solver = make_solver_for(model.pattern());
  return solver->factor(values.data()) == FactorStatus::ok ? std::move(solver) : nullptr;
} catch (const RunError& e) {
  if (e.reason() == Reason::out_of_memory) return nullptr;
  throw;
}

// Empty where round-off decides.
Vector solution(LinearSolver& solver, const Pattern& pattern, const std::vector<double>& values, const Vector& b) {
  Vector x(b.size()), Kx(b.size());
  solver.solve(b, x);
  pattern.multiply(values.data(), x, Kx);
  return x.allFinite() && (Kx - b).norm() <= 1e-3 * b.norm() ? x : Vector();
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
    out.push_back(solver ? solution(*solver, model.pattern(), values, load) : Vector());
  return out;
}

StaticResponse static_response(const FemModel& model, const State& initial, double end) {
  StaticResponse response{peak_load(model, initial, end, 0, model.parts().loads.size()), {}};
  const Vector& load = response.load;
  Vector momentum(load.size());
  model.multiply_mass(initial.v, momentum);
  // Nothing to respond to; or velocities alone, of a body that nothing holds or that is too large for a scale's sake.
  const bool is_free = model.num_dofs() == 3 * model.parts().dofs->num_nodes();
  if (load.isZero(0) && (momentum.isZero(0) || is_free || model.num_dofs() > kLargestForVelocities)) return response;
  std::vector<double> values;
  const auto solver = factored_stiffness(model, values);
  if (!solver) return response;
  const auto solve = [&](const Vector& b) { return solution(*solver, model.pattern(), values, b); };
  Vector u = solve(load), w = solve(momentum);
  if (u.size() == 0 || w.size() == 0) return response;
  response.work = u.dot(load);
  response.displacement = std::move(u);
  // Modes of frequency omega start with v and reach v/omega: the sum of (M v)^2/omega^2 is p K^-1 p.
  const auto amplitude = [&](const Vector& p, const Vector& response_to_p) {
    return std::sqrt(std::max(response_to_p.dot(p), 0.0) / model.parts().mass->total());
  };
  response.vibration = amplitude(momentum, w);
  const Vector blow = impulse(model, initial, end), after = solve(blow);
  response.struck = after.size() > 0 ? amplitude(blow, after) : std::numeric_limits<double>::infinity();
  return response;
}

}  // namespace orthodyn
