#include "lib/fem/fem_state_view.h"

#include "lib/fem/reactions.h"

namespace orthodyn {

namespace {

template <class T, class F>
const T& once(std::optional<T>& kept, F&& compute) {
  if (!kept) kept = compute();
  return *kept;
}

}  // namespace

double FemStateView::energy(EnergyKind kind) const {
  double sum = 0;
  for (const auto& term : parts_.elastic)
    if (term->energy_kind() == kind) sum += term->energy(state());
  for (const auto& term : parts_.loads)
    if (term->energy_kind() == kind) sum += term->energy(state());
  return sum;
}

Vector FemStateView::free_velocity() const {
  Vector v(parts_.dofs->num_dofs());
  parts_.dofs->restrict_to(nodal_.u_rate, v);
  return v;
}

const Vector& FemStateView::free_momentum() const {
  return once(free_momentum_, [&] {
    Vector p(parts_.dofs->num_dofs());
    parts_.mass->multiply(free_velocity(), p);
    return p;
  });
}

double FemStateView::kinetic_energy() const {
  return once(kinetic_energy_, [&] {
    const double free = 0.5 * free_velocity().dot(free_momentum());
    if (!parts_.moved) return free;
    const NodalVector moved = held_part(*parts_.dofs, nodal_.u_rate);
    return free + (nodal_.u_rate - 0.5 * moved).cwiseProduct(parts_.support_mass->times(moved)).sum();
  });
}

const NodalVector& FemStateView::momentum() const {
  return once(momentum_, [&] { return compute_momentum(); });
}

NodalVector FemStateView::compute_momentum() const {
  NodalVector p = NodalVector::Zero(3, nodal_.x.cols());
  parts_.dofs->add_to(free_momentum(), p);
  if (!parts_.moved) return p;
  const NodalVector moved = held_part(*parts_.dofs, nodal_.u_rate), free = nodal_.u_rate - moved;
  return p + parts_.support_mass->times(moved) + held_part(*parts_.dofs, parts_.support_mass->times(free));
}

RecoveredTensors& FemStateView::recovered() const {
  if (!recovered_) recovered_.emplace(*parts_.recovery, state());
  return *recovered_;
}

const std::vector<RegionMeshError>& FemStateView::mesh_errors() const {
  return once(mesh_errors_, [&] { return parts_.recovery->mesh_errors(state()); });
}

const NodalVector& FemStateView::support_forces() const {
  return once(support_forces_, [&] { return orthodyn::support_forces(parts_, nodal_); });
}

}  // namespace orthodyn
