#include "lib/fem/fem_state_view.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace orthodyn {

namespace {

template <class T, class F>
const T& once(std::optional<T>& kept, F&& compute) {
  if (!kept) kept = compute();
  return *kept;
}

// Accelerations of all nodes (m/s^2). Those of free nodes are zero with a lumped mass, which does not couple them with
// held nodes.
NodalVector accelerations(const FemModel::Parts& parts, const NodalExpansion& nodal, const NodalVector& forces) {
  NodalVector a = parts.moved ? parts.moved->accelerations(nodal.time) : NodalVector::Zero(3, nodal.x.cols());
  if (parts.mass->lumped()) return a;
  Vector v(parts.dofs->num_dofs()), free(parts.dofs->num_dofs());
  parts.dofs->restrict_to(nodal.u_rate, v);
  free_forces(parts, nodal, v, forces, free);
  parts.mass->solve(free);
  parts.dofs->add_to(free, a);
  if (parts.moved) parts.dofs->ties().place(a);
  return a;
}

// The output of this name, which may be "REGION.FIELD".
FemOutput find_output(const FemModel::Parts& parts, const std::string& name) {
  for (const auto& output : all_outputs())
    if (output.info.name == name) return output;
  for (const auto& output : reaction_outputs(parts.supports))
    if (output.info.name == name) return output;
  for (const auto& output : joint_outputs(parts.joints))
    if (output.info.name == name) return output;
  for (const auto& output : tie_outputs(parts.ties))
    if (output.info.name == name) return output;
  for (const auto& output : contact_outputs(parts.contacts))
    if (output.info.name == name) return output;
  for (const FieldRegion& region : field_regions(parts.elastic)) {
    const std::string prefix = region.name + ".";
    if (!name.starts_with(prefix)) continue;
    for (const FemOutput& output : nodal_outputs(region.parts))
      if (prefix + output.info.name == name) return output;
  }
  throw std::logic_error("no output named " + name);
}

// Largest (sign 1) or smallest (sign -1) value of all ranks, and its location; NaN if the value of any rank is NaN.
std::vector<double> extreme_of_ranks(const Ranks& ranks, std::vector<double> here, double sign) {
  if (ranks.any(std::isnan(here[0]))) {
    here[0] = std::numeric_limits<double>::quiet_NaN();
    return here;
  }
  const double extreme = ranks.max(sign * here[0]);
  if (here.size() > 1) here[1] = -ranks.max(sign * here[0] == extreme ? -here[1] : -1e300);  // lowest such location
  here[0] = sign * extreme;
  return here;
}

std::vector<double> reduced(const FemModel::Parts& parts, const FemOutput& output, std::vector<double> here) {
  const Ranks& ranks = parts.subdomain->ranks();
  if (output.reduction == Reduction::none) return here;
  if (output.reduction == Reduction::minimum) return extreme_of_ranks(ranks, std::move(here), -1);
  if (output.reduction == Reduction::maximum) return extreme_of_ranks(ranks, std::move(here), 1);
  if (output.info.location == Location::node)
    return parts.subdomain->whole_field(here, static_cast<std::size_t>(output.info.components));
  ranks.sum(here);
  return here;
}

}  // namespace

double FemStateView::energy(EnergyKind kind) const {
  double sum = 0;
  for (const Term* term : all_terms(parts_))
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
  return once(momentum_, [&]() -> NodalVector {
    NodalVector p = NodalVector::Zero(3, nodal_.x.cols());
    parts_.dofs->add_forces_to(free_momentum(), p);
    if (!parts_.moved) return p;
    const NodalVector moved = held_part(*parts_.dofs, nodal_.u_rate), free = nodal_.u_rate - moved;
    return p + parts_.support_mass->times(moved) + held_part(*parts_.dofs, parts_.support_mass->times(free));
  });
}

RecoveredTensors& FemStateView::recovered() const {
  if (!recovered_) recovered_.emplace(*parts_.recovery, state());
  return *recovered_;
}

const std::vector<RegionMeshError>& FemStateView::mesh_errors() const {
  return once(mesh_errors_, [&] { return parts_.recovery->mesh_errors(state()); });
}

NodalVector FemStateView::forces() const {
  NodalVector f = term_forces(parts_, nodal_);
  if (lambda_.size() > 0) f += joint_forces(parts_, nodal_, lambda_);
  return f;
}

// The lumped masses of tied nodes, which have moved to their leaders, and their weight: m (a + alpha v - g).
NodalVector FemStateView::lumped_inertia_of_ties(const NodalVector& f) const {
  const Ties& ties = parts_.dofs->ties();
  const Vector& masses = parts_.mass->nodal();
  Vector free(parts_.dofs->num_dofs());
  free_forces(parts_, nodal_, free_velocity(), f, free);
  parts_.mass->solve(free);
  NodalVector a = parts_.moved ? parts_.moved->accelerations(nodal_.time) : NodalVector::Zero(3, f.cols());
  parts_.dofs->add_to(free, a);
  std::vector<const Term*> weights;
  for (const auto& term : parts_.loads)
    if (term->energy_kind() == EnergyKind::gravitational) weights.push_back(term.get());
  NodalVector g = term_forces(parts_, nodal_, weights);
  for (Eigen::Index i = 0; i < g.cols(); ++i)
    if (masses[i] > 0) g.col(i) /= masses[i];
  a += parts_.mass_damping * nodal_.u_rate - g;
  ties.place(a);
  return a * parts_.mass->tied().asDiagonal();
}

const NodalVector& FemStateView::tie_forces() const {
  return once(tie_forces_, [&]() -> NodalVector {
    const Ties& ties = parts_.dofs->ties();
    const NodalVector f = forces();
    NodalVector own =
        parts_.tied_mass
            ? parts_.tied_mass->times(accelerations(parts_, nodal_, f) + parts_.mass_damping * nodal_.u_rate)
            : lumped_inertia_of_ties(f);
    for (Eigen::Index i = 0; i < f.cols(); ++i)
      if (ties.is_tied(static_cast<int>(i))) own.col(i) -= f.col(i);
    // Nodes that follow tied nodes hand their forces on; a chain has at most as many links as there are ties.
    NodalVector total = own;
    for (std::size_t link = 1; link < parts_.ties.size(); ++link) {
      NodalVector next = own;
      for (const NamedTie& tie : parts_.ties)
        for (const TiedNode& tied : tie.nodes)
          for (const auto& [leader, weight] : tied.leaders)
            if (ties.is_tied(leader)) next.col(leader) += weight * total.col(tied.node);
      total = std::move(next);
    }
    return total;
  });
}

const NodalVector& FemStateView::support_forces() const {
  return once(support_forces_, [&] {
    NodalVector f = forces();
    parts_.dofs->ties().gather(f);
    const NodalVector a = accelerations(parts_, nodal_, f) + parts_.mass_damping * nodal_.u_rate;
    return held_part(*parts_.dofs, parts_.support_mass->times(a) - f);
  });
}

std::vector<double> FemStateView::evaluate(const std::string& name) const {
  const FemOutput output = find_output(parts_, name);
  std::vector<double> here = output.compute(*this);
  return parts_.subdomain ? reduced(parts_, output, std::move(here)) : here;
}

std::vector<double> FemStateView::evaluate_at(const std::string& name, int node, int components) const {
  const FemOutput output = find_output(parts_, name);
  if (output.compute_at && (!parts_.subdomain || output.reduction == Reduction::none))
    return output.compute_at(*this, node);
  const auto [field, is_new] = whole_fields_.try_emplace(name);
  if (is_new) field->second = evaluate(name);
  const auto first = field->second.begin() + std::ptrdiff_t{components} * node;
  return {first, first + components};
}

}  // namespace orthodyn
