#include "lib/analysis/static_response.h"

#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

Vector peak_load(const FemModel& model, double start, double end) {
  const auto& parts = model.parts();
  NodalVector sum = NodalVector::Zero(3, parts.rest->cols());
  const NodalVector still = NodalVector::Zero(3, parts.rest->cols());
  for (const auto& load : parts.loads) load->add_peak_force({start, *parts.rest, still, still}, end, sum);
  Vector free(model.num_dofs());
  parts.dofs->restrict_to(sum, free);
  return free;
}

}  // namespace

StaticResponse static_response(const FemModel& model, double start, double end) {
  StaticResponse response{peak_load(model, start, end), {}};
  const Vector& load = response.load;
  if (load.norm() == 0) return response;
  const Vector zero = Vector::Zero(model.num_dofs());
  Linearization at;
  model.linearize(0, zero, zero, TangentKind::gauss_newton, at);
  std::vector<double> values(at.stiffness.size());
  model.combine({0, 0, 1}, at, values.data());
  auto solver = solver_registry().at(model.pattern().symmetric ? "cholmod" : "klu").make();
  solver->analyze(model.pattern());
  if (solver->factor(values.data()) != FactorStatus::ok) return response;
  Vector u(load.size()), residual(load.size());
  solver->solve(load, u);
  model.pattern().multiply(values.data(), u, residual);
  if (!u.allFinite() || !((residual - load).norm() < 1e-3 * load.norm())) return response;
  response.work = u.dot(load);
  response.displacement = std::move(u);
  return response;
}

}  // namespace orthodyn
