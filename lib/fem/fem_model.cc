#include "lib/fem/fem_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "lib/core/parallel.h"
#include "lib/fem/contact/contact.h"

namespace orthodyn {

NodalExpansion::NodalExpansion(const FemModel::Parts& parts, double at_time, const ConstVectorRef& q,
                               const ConstVectorRef& v, double factor)
    : time(at_time),
      t(parts.loads_at.value_or(at_time)),
      load_factor(factor),
      u(NodalVector::Zero(3, parts.rest->cols())),
      u_rate(u) {
  parts.dofs->add_to(q, u);
  parts.dofs->add_to(v, u_rate);
  if (parts.subdomain) {
    parts.subdomain->copy_from_owners(u);
    parts.subdomain->copy_from_owners(u_rate);
  }
  if (parts.moved) {
    parts.moved->place(at_time, u, u_rate);
    parts.dofs->ties().place(u);
    parts.dofs->ties().place(u_rate);
  }
  x = *parts.rest + u;
}

FemModel::FemModel(Parts parts) : parts_(std::move(parts)) {
  parts_.recovery = std::make_unique<StressRecovery>(parts_.mesh, parts_.elastic, parts_.subdomain.get());
  internal_ = make_internal_variables(parts_);
  constraints_ = make_joint_constraints(parts_);
  if (parts_.subdomain || internal_) return;
  const auto has_energy = [](const auto& term) { return term->has_energy(); };
  const auto has_mean_force = [](const auto& term) { return term->has_mean_force(); };
  const bool pulled = supports_pull(parts_);  // the pull is a force without energy
  if (!pulled && std::all_of(parts_.elastic.begin(), parts_.elastic.end(), has_energy) &&
      std::all_of(parts_.loads.begin(), parts_.loads.end(), has_mean_force))
    mean_force_ = make_mean_force(parts_);
}

std::vector<const Term*> all_terms(const FemModel::Parts& parts) {
  std::vector<const Term*> terms;
  for (const auto& term : parts.elastic) terms.push_back(term.get());
  for (const auto& term : parts.loads) terms.push_back(term.get());
  return terms;
}

std::vector<std::string> term_descriptions(const FemModel::Parts& parts) {
  std::vector<std::string> all;
  std::map<std::string, std::size_t> cells;  // of stiffness factors, by region
  for (const auto& term : parts.elastic) {
    const ElasticRegion& own = term->definition();
    if (own.stiffness_cell < 0) all.push_back(term->description());
    else if (++cells[own.mesh_region] == 1) all.push_back(term->description() + ", as the other cells of its grid");
  }
  if (parts.subdomain) all.insert(all.end(), parts.load_descriptions.begin(), parts.load_descriptions.end());
  else
    for (const auto& term : parts.loads) all.push_back(term->description());
  return all;
}

NodalVector term_forces(const FemModel::Parts& parts, const NodalExpansion& nodal) {
  return term_forces(parts, nodal, all_terms(parts));
}

NodalVector term_forces(const FemModel::Parts& parts, const NodalExpansion& nodal,
                        const std::vector<const Term*>& some) {
  NodalVector sum = NodalVector::Zero(3, nodal.x.cols());
  on_all_ranks(parts.subdomain.get(), [&] {
    if (nodal.load_factor == 1) {
      for (const Term* term : some) term->add_force(nodal.state(), sum);
    } else {
      for (const Term* term : some)
        if (term->is_load()) term->add_force(nodal.state(), sum);
      sum *= nodal.load_factor;
      for (const Term* term : some)
        if (!term->is_load()) term->add_force(nodal.state(), sum);
    }
    if (parts.subdomain && !(sum.allFinite() && nodal.u_rate.allFinite()))
      throw RecoverableError("the force is not finite");
  });
  if (parts.subdomain) parts.subdomain->add_to_owners(sum);
  return sum;
}

void term_tangents(const FemModel::Parts& parts, const NodalExpansion& nodal, const std::vector<const Term*>& some,
                   TangentKind kind, Linearization& out) {
  const auto size = parts.pattern->pattern().row.size();
  const bool damped = parts.traits.damping_matrix;
  out.stiffness.assign(size, 0);
  if (damped) out.damping.assign(size, 0);
  on_all_ranks(parts.subdomain.get(), [&] {
    for (const Term* term : some)
      term->add_tangent(nodal.state(), kind, out.stiffness.data(), damped ? out.damping.data() : nullptr);
  });
}

void term_predicted_tangents(const FemModel::Parts& parts, const NodalExpansion& before, const NodalExpansion& nodal,
                             const std::vector<const Term*>& some, Linearization& out) {
  out.stiffness.assign(parts.pattern->pattern().row.size(), 0);
  on_all_ranks(parts.subdomain.get(), [&] {
    for (const Term* term : some) term->add_predicted_tangent(before.state(), nodal.state(), out.stiffness.data());
  });
}

bool supports_pull(const FemModel::Parts& parts) { return parts.moved && !parts.mass->lumped(); }

namespace {

// Subtracts the free part of M x from f. Precondition: x is zero at free coordinates.
void subtract_inertia(const FemModel::Parts& parts, const NodalVector& x, VectorRef f) {
  Vector pull(f.size());
  parts.dofs->restrict_to(parts.support_mass->times(x), pull);
  f -= pull;
}

}  // namespace

void add_mass_damping(const FemModel::Parts& parts, const NodalExpansion& nodal, const ConstVectorRef& v, VectorRef f) {
  Vector momentum(v.size());
  parts.mass->multiply(v, momentum);
  f -= parts.mass_damping * momentum;
  if (supports_pull(parts)) subtract_inertia(parts, parts.mass_damping * held_part(*parts.dofs, nodal.u_rate), f);
}

void add_support_pull(const FemModel::Parts& parts, const NodalExpansion& nodal, VectorRef f) {
  subtract_inertia(parts, parts.moved->accelerations(nodal.time), f);
}

void free_forces(const FemModel::Parts& parts, const NodalExpansion& nodal, const ConstVectorRef& v,
                 const NodalVector& forces, VectorRef out) {
  parts.dofs->restrict_forces_to(forces, out);
  if (parts.mass_damping > 0) add_mass_damping(parts, nodal, v, out);
  if (supports_pull(parts)) add_support_pull(parts, nodal, out);
}

void FemModel::force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  const NodalExpansion nodal(parts_, t, q, v);
  free_forces(parts_, nodal, v, term_forces(parts_, nodal), f);
}

void FemModel::assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                        Linearization& out) const {
  term_tangents(parts_, NodalExpansion(parts_, t, q, v), all_terms(parts_), kind, out);
}

void FemModel::assemble_predicted(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                                  Linearization& out) const {
  const Vector still = Vector::Zero(q.size());
  const NodalExpansion before(parts_, t_before, q_before, still), nodal(parts_, t, q, still);
  term_predicted_tangents(parts_, before, nodal, all_terms(parts_), out);
}

void FemModel::combine(const Weights& w, const Linearization& at, double* values) const {
  constexpr Eigen::Index kPart = 1 << 15;
  const auto size = static_cast<Eigen::Index>(at.stiffness.size());
  parallel_for(static_cast<int>((size + kPart - 1) / kPart), [&](int i) {
    const Eigen::Index begin = i * kPart, length = std::min(kPart, size - begin);
    Eigen::Map<Vector> A(values + begin, length);
    A = w.stiffness * Eigen::Map<const Vector>(at.stiffness.data() + begin, length);
    if (!at.damping.empty()) A += w.damping * Eigen::Map<const Vector>(at.damping.data() + begin, length);
  });
  if (const double m = w.mass + w.damping * parts_.mass_damping; m != 0) parts_.mass->add_to(m, values);
}

void FemModel::multiply_matrix(const double* values, const ConstVectorRef& x, VectorRef y) const {
  if (!parts_.subdomain) return pattern().multiply(values, x, y);
  const DofMap& dofs = *parts_.dofs;
  NodalVector nodal = NodalVector::Zero(3, dofs.num_nodes());
  dofs.add_to(x, nodal);
  parts_.subdomain->copy_from_owners(nodal);
  Vector in(dofs.num_dofs_here()), out(dofs.num_dofs_here());
  dofs.restrict_here_to(nodal, in);
  pattern().multiply(values, in, out);
  nodal.setZero();
  dofs.add_here_to(out, nodal);
  parts_.subdomain->add_to_owners(nodal);
  dofs.restrict_to(nodal, y);
}

Eigen::Index FemModel::num_dofs_of_all() const {
  return parts_.subdomain ? static_cast<Eigen::Index>(pattern().share->unknowns) : num_dofs();
}

Vector FemModel::whole_of(const Vector& part) const {
  if (!parts_.subdomain) return part;
  Vector all = Vector::Zero(num_dofs_of_all());
  all(parts_.unknowns) = part;
  ranks()->sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

State FemModel::whole(const State& state) const {
  State out = state;
  out.q = whole_of(state.q);
  out.v = whole_of(state.v);
  return out;
}

Vector FemModel::part_of(const Vector& all) const { return parts_.subdomain ? Vector(all(parts_.unknowns)) : all; }

State FemModel::part(const State& whole) const {
  State out = whole;
  out.q = part_of(whole.q);
  out.v = part_of(whole.v);
  return out;
}

// Rotations are about the mean node position and scaled by the body's size, so that all columns have similar norms.
Eigen::MatrixXd FemModel::rigid_motions(const ConstVectorRef& q) const {
  NodalVector x = *parts_.rest;
  parts_.dofs->add_to(q, x);
  const auto own = x.leftCols(parts_.dofs->num_owned_nodes());
  Eigen::Vector4d sums(own.row(0).sum(), own.row(1).sum(), own.row(2).sum(), static_cast<double>(own.cols()));
  if (ranks()) ranks()->sum({sums.data(), 4});
  x.colwise() -= Vec3(sums.head<3>() / sums[3]);
  const double size = std::max(space().largest_entry(own.reshaped()), std::numeric_limits<double>::min());
  Eigen::MatrixXd motions(num_dofs(), 6);
  for (int k = 0; k < 3; ++k) {
    NodalVector shift = NodalVector::Zero(3, x.cols()), turn(3, x.cols());
    shift.row(k).setOnes();
    for (Eigen::Index i = 0; i < x.cols(); ++i) turn.col(i) = Vec3::Unit(k).cross(Vec3(x.col(i))) / size;
    parts_.dofs->restrict_to(shift, motions.col(k));
    parts_.dofs->restrict_to(turn, motions.col(3 + k));
  }
  return motions;
}

// The largest element frequency bounds the frequencies of the mesh (Irons 1971). Gershgorin's circles bound the
// contributions of other terms.
double FemModel::frequency_bound() const {
  double largest = 0;
  for (std::size_t k = 0; k < parts_.elastic.size(); ++k)
    largest = std::max(largest, parts_.elastic[k]->max_frequency_squared(parts_.densities[k]));
  Vector row_sums = Vector::Zero(parts_.mass->nodal().size());
  for (const auto& term : parts_.loads) term->add_stiffness_bound(row_sums);
  largest = space().largest(largest) + largest_quotient(parts_, std::move(row_sums));
  return std::sqrt(parts_.mass->frequency_excess() * largest);
}

double largest_quotient(const FemModel::Parts& parts, Vector row_sums) {
  if (!parts.subdomain) {
    if (parts.mass->lumped()) parts.dofs->ties().move_bounds(row_sums);
    double largest = 0;  // tied nodes have neither
    for (Eigen::Index i = 0; i < row_sums.size(); ++i)
      if (row_sums[i] > 0) largest = std::max(largest, row_sums[i] / parts.mass->nodal()[i]);
    return largest;
  }
  parts.subdomain->add_to_owners(row_sums);
  const Eigen::Index own = parts.dofs->num_owned_nodes();
  const auto quotients = row_sums.head(own).cwiseQuotient(parts.mass->nodal().head(own));
  return parts.subdomain->ranks().max(own > 0 ? quotients.maxCoeff() : 0);
}

std::vector<std::string> FemModel::force_parts() const { return part_names(parts_); }

std::optional<std::vector<std::string>> FemModel::load_parts() const {
  const auto terms = all_terms(parts_);
  const auto names = term_names(terms);
  std::vector<std::string> loads;
  for (std::size_t k = 0; k < terms.size(); ++k)
    if (terms[k]->is_load()) loads.push_back(names[k]);
  return loads;
}

std::vector<double> FemModel::breakpoints(double start, double end) const {
  std::vector<double> times;
  for (const Term* term : all_terms(parts_)) {
    const auto more = term->breakpoints(start, end);
    times.insert(times.end(), more.begin(), more.end());
  }
  if (parts_.moved) {
    const auto more = parts_.moved->breakpoints(start, end);
    times.insert(times.end(), more.begin(), more.end());
  }
  for (const Joint& joint : parts_.joints)
    if (const JointEquation* motor = joint.motor()) {
      const auto more = times_between(motor->motor.factor->kinks(), start, end);
      times.insert(times.end(), more.begin(), more.end());
    }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

StepLimits FemModel::step_limits(double start, double end) const {
  StepLimits limits;
  for (const Term* term : all_terms(parts_)) limits.add(term->step_limits(start, end));
  for (const Joint& joint : parts_.joints)
    if (const JointEquation* motor = joint.motor()) limits.add(motor->motor.factor->step_limits(start, end));
  const auto& moved = parts_.subdomain ? parts_.moved_everywhere : parts_.moved;
  if (moved) limits.add(moved->step_limits(start, end));
  return limits;
}

double FemModel::longest_step(const State& state) const {
  double longest = std::numeric_limits<double>::infinity();
  std::optional<NodalExpansion> nodal;
  for (const auto& term : parts_.loads) {
    if (!term->contact()) continue;
    if (!nodal) nodal.emplace(parts_, state.t, state.q, state.v);
    longest = std::min(longest, term->contact()->longest_step(nodal->state()));
  }
  return longest;
}

Angles FemModel::angles(const State& state) const {
  const auto turns = [](const Joint& joint) { return joint.turn() != nullptr; };
  const auto count = std::count_if(parts_.joints.begin(), parts_.joints.end(), turns);
  if (count == 0) return {};
  const NodalExpansion nodal(parts_, state.t, state.q, state.v);
  Angles out{Vector(count), Vector(count)};
  Eigen::Index i = 0;
  for (const Joint& joint : parts_.joints) {
    const JointCoordinate* turn = joint.turn();
    if (!turn) continue;
    out.values[i] = turn->value(nodal.u);
    out.rates[i++] = turn->rate(nodal.u, nodal.u_rate);
  }
  return out;
}

Geometry FemModel::geometry() const { return {parts_.mesh.nodes, parts_.mesh.cells}; }

std::vector<std::pair<std::string, std::size_t>> FemModel::memory() const {
  const auto& mesh = parts_.mesh;
  const auto nodes = mesh.nodes.size();
  std::size_t elements = 0;
  for (const Term* term : all_terms(parts_)) elements += term->bytes();
  const auto& pattern = parts_.pattern->pattern();
  // Displacements, velocities, positions and forces of all nodes during a force evaluation.
  const std::size_t expansion = 4 * nodes * sizeof(Vec3);
  std::vector<std::pair<std::string, std::size_t>> all = {
      {"mesh", nodes * (2 * sizeof(Vec3) + 3 * sizeof(int)) + mesh.cells.bytes() + mesh.cells.size() * sizeof(int)},
      {"elements", elements},
      {"pattern", (pattern.row.size() + pattern.column_start.size()) * sizeof(int)},
      {"mass", parts_.mass->bytes()},
      {"nodal vectors", expansion}};
  if (parts_.support_mass)
    all.emplace_back("supports", parts_.support_mass->bytes() + (parts_.moved ? parts_.moved->bytes() : 0));
  return all;
}

}  // namespace orthodyn
