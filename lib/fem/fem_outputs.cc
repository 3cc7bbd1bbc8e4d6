// The named fields and scalars of a FemModel.
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>

#include "lib/fem/reactions.h"

namespace orthodyn {

namespace {

using Parts = FemModel::Parts;
using Values = std::vector<double>;

struct Output {
  OutputInfo info;
  std::function<Values(const Parts&, const NodalExpansion&)> compute;
};

template <class M>
Values flat(const M& m) {
  return Values(m.data(), m.data() + m.size());
}

// One value set per cell of the mesh, from its elastic term.
Values per_cell(const Parts& parts, std::size_t components,
                const std::function<void(const ElasticTerm&, int k, double* out)>& f) {
  Values out(parts.mesh.region_of.size() * components);
  for (const auto& term : parts.elastic)
    for (int k = 0; k < term->size(); ++k)
      f(*term, k, out.data() + static_cast<std::size_t>(term->cell(k)) * components);
  return out;
}

void write_voigt(const Mat3& s, double* out) {
  const double v[] = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
  std::copy(std::begin(v), std::end(v), out);
}

using Observed = std::function<Mat3(const PointObservation&)>;

Output symmetric_tensor(const std::string& name, const std::string& unit, const std::string& sentence,
                        const Observed& pick) {
  return {{name, Location::cell, 6, unit, sentence},
          [pick](const Parts& parts, const NodalExpansion& nodal) {
            return per_cell(parts, 6, [&](const ElasticTerm& term, int k, double* out) {
              write_voigt(pick(term.observe(k, nodal.state())), out);
            });
          }};
}

Output material_axis(int axis) {
  return {{"material_axis_" + std::to_string(axis + 1), Location::cell, 3, "1",
           "Material axis " + std::to_string(axis + 1) + ", rotated with the element."},
          [axis](const Parts& parts, const NodalExpansion& nodal) {
            return per_cell(parts, 3, [&](const ElasticTerm& term, int k, double* out) {
              const Vec3 direction = term.observe(k, nodal.state()).axes.col(axis);
              std::copy(direction.begin(), direction.end(), out);
            });
          }};
}

double energy_of(EnergyKind kind, const Parts& parts, const NodalExpansion& nodal) {
  double sum = 0;
  for (const auto& term : parts.elastic)
    if (term->energy_kind() == kind) sum += term->energy(nodal.state());
  for (const auto& term : parts.loads)
    if (term->energy_kind() == kind) sum += term->energy(nodal.state());
  return sum;
}

Vector momentum_dofs(const Parts& parts, const NodalExpansion& nodal) {
  Vector v(parts.dofs->num_dofs()), p(parts.dofs->num_dofs());
  parts.dofs->restrict_to(nodal.u_rate, v);
  parts.mass->multiply(v, p);
  return p;
}

// v_f M_ff v_f/2 + v_f M_fc v_c + v_c M_cc v_c/2 for free coordinates f and moved ones c.
double kinetic_energy(const Parts& parts, const NodalExpansion& nodal) {
  Vector v(parts.dofs->num_dofs());
  parts.dofs->restrict_to(nodal.u_rate, v);
  const double free = 0.5 * v.dot(momentum_dofs(parts, nodal));
  if (!parts.moved) return free;
  const NodalVector moved = held_part(*parts.dofs, nodal.u_rate);
  return free + (nodal.u_rate - 0.5 * moved).cwiseProduct(parts.support_mass->times(moved)).sum();
}

// M_ff v_f, and with moved nodes M v.
NodalVector nodal_momentum(const Parts& parts, const NodalExpansion& nodal) {
  NodalVector p = NodalVector::Zero(3, nodal.x.cols());
  parts.dofs->add_to(momentum_dofs(parts, nodal), p);
  if (!parts.moved) return p;
  const NodalVector moved = held_part(*parts.dofs, nodal.u_rate), free = nodal.u_rate - moved;
  return p + parts.support_mass->times(moved) + held_part(*parts.dofs, parts.support_mass->times(free));
}

Values angular_momentum(const Parts& parts, const NodalExpansion& nodal) {
  const NodalVector p = nodal_momentum(parts, nodal);
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < p.cols(); ++i) sum += nodal.x.col(i).cross(p.col(i));
  return flat(sum);
}

double dissipated_power(const Parts& parts, const NodalExpansion& nodal) {
  double power = parts.mass_damping > 0 ? 2 * parts.mass_damping * kinetic_energy(parts, nodal) : 0;
  for (const auto& term : parts.elastic) power += term->dissipation(nodal.state());
  for (const auto& term : parts.loads) power += term->dissipation(nodal.state());
  return power;
}

double load_power(const Parts& parts, const NodalExpansion& nodal) {
  double power = support_power(parts, nodal);
  for (const auto& term : parts.loads) power += term->load_power(nodal.state());
  return power;
}

// The largest force on a node, were the body at rest in this shape.
double imbalance(const Parts& parts, const NodalExpansion& nodal) {
  const Vector still = Vector::Zero(parts.dofs->num_dofs());
  Vector q(still.size()), free(still.size());
  parts.dofs->restrict_to(nodal.x - *parts.rest, q);
  const NodalExpansion resting(parts, nodal.t, q, still);
  free_forces(parts, resting, still, term_forces(parts, resting), free);
  NodalVector forces = NodalVector::Zero(3, nodal.x.cols());
  parts.dofs->add_to(free, forces);
  if (!forces.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(forces.colwise().squaredNorm().maxCoeff());
}

Output scalar(const std::string& name, const std::string& unit, const std::string& sentence,
              const std::function<double(const Parts&, const NodalExpansion&)>& f) {
  return {{name, Location::global, 1, unit, sentence},
          [f](const Parts& parts, const NodalExpansion& nodal) { return Values{f(parts, nodal)}; }};
}

const std::vector<Output>& all_outputs() {
  static const std::vector<Output> all = {
      {{"displacement", Location::node, 3, "m", "Displacement from the rest shape."},
       [](const Parts& p, const NodalExpansion& n) { return flat(NodalVector(n.x - *p.rest)); }},
      {{"velocity", Location::node, 3, "m/s", "Velocity."},
       [](const Parts&, const NodalExpansion& n) { return flat(n.u_rate); }},
      {{"region", Location::cell, 1, "1", "Index of the region."},
       [](const Parts& p, const NodalExpansion&) {
         return Values(p.mesh.region_of.begin(), p.mesh.region_of.end());
       }},
      {{"det_f", Location::cell, 1, "1", "Volume ratio det F; not positive where inverted."},
       [](const Parts& p, const NodalExpansion& n) {
         return per_cell(p, 1, [&](const ElasticTerm& term, int k, double* out) {
           *out = term.det_F(k, n.state());
         });
       }},
      material_axis(0),
      material_axis(1),
      material_axis(2),
      symmetric_tensor("strain", "1", "Strain S - I in material axes: 11, 22, 33, 12, 23, 31 (tensor shear).",
                       [](const PointObservation& o) { return o.strain; }),
      symmetric_tensor("stress", "Pa",
                       "Elastic Cauchy stress in space: xx, yy, zz, xy, yz, zx; NaN where inverted.",
                       [](const PointObservation& o) { return o.cauchy; }),
      symmetric_tensor("stress_material", "Pa",
                       "Elastic Cauchy stress in the rotated material axes: 11, 22, 33, 12, 23, 31.",
                       [](const PointObservation& o) { return Mat3(o.axes.transpose() * o.cauchy * o.axes); }),
      scalar("energy.kinetic", "J", "Kinetic energy.", kinetic_energy),
      scalar("energy.elastic", "J", "Elastic energy, that of springs and of contact included.",
             [](const Parts& p, const NodalExpansion& n) { return energy_of(EnergyKind::elastic, p, n); }),
      scalar("energy.gravitational", "J", "Energy in the gravity field, zero at rest.",
             [](const Parts& p, const NodalExpansion& n) { return energy_of(EnergyKind::gravitational, p, n); }),
      scalar("power.dissipated", "W", "Power taken by damping.", dissipated_power),
      scalar("power.loads", "W", "Power of loads and of moved supports.", load_power),
      scalar("imbalance", "N", "The largest force on a node, were the body at rest in this shape; 0 in equilibrium.",
             imbalance),
      {{"det_f.smallest", Location::global, 2, "1", "The smallest det F, and the element that has it."},
       [](const Parts& p, const NodalExpansion& n) {
         Values out{std::numeric_limits<double>::infinity(), -1};
         for (const auto& term : p.elastic)
           for (int k = 0; k < term->size(); ++k)
             if (const double d = term->det_F(k, n.state()); d < out[0])
               out = {d, static_cast<double>(term->cell(k))};
         return out;
       }},
      {{"speed.largest", Location::global, 2, "m/s", "The largest speed, and the node that has it."},
       [](const Parts&, const NodalExpansion& n) {
         Eigen::Index node = 0;
         const double speed = std::sqrt(n.u_rate.colwise().squaredNorm().maxCoeff(&node));
         return Values{speed, static_cast<double>(node)};
       }},
      {{"momentum.linear", Location::global, 3, "kg m/s", "Linear momentum of the free coordinates, and of moved ones."},
       [](const Parts& p, const NodalExpansion& n) { return flat(Vec3(nodal_momentum(p, n).rowwise().sum())); }},
      {{"momentum.angular", Location::global, 3, "kg m^2/s", "Angular momentum about the origin."},
       angular_momentum},
  };
  return all;
}

// Of the supports whose reactions are wanted.
std::vector<Output> reaction_outputs(const std::vector<Support>& supports) {
  std::vector<Output> out;
  for (const Support& support : supports) {
    out.push_back({{"reaction." + support.name, Location::global, 3, "N", "Force of the support on the body."},
                   [&support](const Parts& p, const NodalExpansion& n) {
                     return flat(reaction(support, support_forces(p, n)));
                   }});
    out.push_back({{"torque." + support.name, Location::global, 3, "N m", "Its torque about the middle of the nodes."},
                   [&support](const Parts& p, const NodalExpansion& n) {
                     return flat(reaction_torque(support, support_forces(p, n), n.x));
                   }});
  }
  return out;
}

}  // namespace

std::vector<OutputInfo> FemModel::outputs() const {
  std::vector<OutputInfo> infos;
  for (const auto& output : all_outputs()) infos.push_back(output.info);
  for (const auto& output : reaction_outputs(parts_.supports)) infos.push_back(output.info);
  return infos;
}

std::vector<double> FemModel::evaluate(const std::string& name, const State& state) const {
  const auto find_in = [&](const std::vector<Output>& outputs) -> std::optional<Values> {
    for (const auto& output : outputs)
      if (output.info.name == name) return output.compute(parts_, NodalExpansion(parts_, state.t, state.q, state.v));
    return {};
  };
  if (const auto found = find_in(all_outputs())) return *found;
  if (const auto found = find_in(reaction_outputs(parts_.supports))) return *found;
  throw std::logic_error("no output named " + name);
}

}  // namespace orthodyn
