// The outputs of a FemModel: fields and scalars by name.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/fem/contact/contact.h"
#include "lib/fem/fem_state_view.h"
#include "lib/fem/nodal_fields.h"
#include "lib/fem/terms/added_term.h"

namespace orthodyn {

namespace {

using View = FemStateView;
using Values = std::vector<double>;

template <class M>
Values flat(const M& m) {
  return Values(m.data(), m.data() + m.size());
}

enum class OfPlies { mean, first, smallest };

// Values of all mesh cells, `components` per cell. f writes the values of element k of a term to `out`. A cell with
// plies has the mean over its thickness, the values of its first ply, or the smallest of its plies; a cell of a rigid
// body has none, NaN.
Values per_cell(const View& view, std::size_t components, OfPlies of_plies,
                const std::function<void(const ElasticTerm&, int k, double* out)>& f) {
  Values out(view.parts().mesh.region_of.size() * components), of_ply(components);
  std::vector<double> filled(view.parts().mesh.region_of.size(), 0);  // share of the cell's thickness
  for (const auto& term : view.parts().elastic) {
    const double share = term->definition().share;
    for (int k = 0; k < term->size(); ++k) {
      const auto cell = static_cast<std::size_t>(term->cell(k));
      double* const own = out.data() + cell * components;
      const bool is_first = filled[cell] == 0;
      if (is_first && (share == 1 || of_plies != OfPlies::mean)) {
        f(*term, k, own);
      } else if (of_plies != OfPlies::first) {
        f(*term, k, of_ply.data());
        for (std::size_t c = 0; c < components; ++c)
          own[c] = of_plies == OfPlies::mean ? own[c] + share * of_ply[c] : std::min(own[c], of_ply[c]);
      }
      filled[cell] += share;
    }
  }
  for (std::size_t cell = 0; cell < filled.size() && !view.parts().rigid_bodies.empty(); ++cell)
    if (filled[cell] == 0)
      std::fill_n(out.data() + cell * components, components, std::numeric_limits<double>::quiet_NaN());
  return out;
}

FemOutput mean_of_cells(const TensorField& tensor) {
  return {{tensor.name, Location::cell, 6, tensor.unit, fmt::format("{}. Element mean.", tensor.sentence),
           tensor.components},
          [&tensor](const View& view) {
            const OfPlies of_plies = tensor.in_space ? OfPlies::mean : OfPlies::first;
            return per_cell(view, 6, of_plies, [&](const ElasticTerm& term, int k, double* out) {
              const Vec6 v = tensor(term.observe(k, view.state()));
              std::copy(v.begin(), v.end(), out);
            });
          }};
}

FemOutput at_nodes(const TensorField& tensor, const FieldParts& parts) {
  return {
      {fmt::format("nodal_{}", tensor.name), Location::node, 6, tensor.unit,
       fmt::format("{}. Recovered at the nodes.", tensor.sentence), tensor.components},
      [&tensor, parts](const View& view) { return tensor_at_nodes(view.recovered(), tensor, parts); },
      Reduction::none,
      [&tensor, parts](const View& view, int node) { return tensor_at_node(view.recovered(), tensor, parts, node); }};
}

FemOutput at_nodes(const DerivedField& derived, const FieldParts& parts) {
  const auto count = static_cast<int>(std::max<std::size_t>(derived.components.size(), 1));
  return {{derived.name, Location::node, count, derived.unit, derived.sentence, derived.components},
          [&derived, parts](const View& view) {
            return derived_at_nodes(view.recovered(), view.parts().elastic, derived, parts);
          },
          Reduction::none,
          [&derived, parts](const View& view, int node) {
            return derived_at_node(view.recovered(), view.parts().elastic, derived, parts, node);
          }};
}

}  // namespace

std::vector<FemOutput> nodal_outputs(const FieldParts& parts) {
  std::vector<FemOutput> out;
  for (const TensorField& tensor : tensor_fields()) out.push_back(at_nodes(tensor, parts));
  for (const DerivedField& derived : derived_fields()) out.push_back(at_nodes(derived, parts));
  return out;
}

namespace {

// Estimated energy of the discretisation error per volume of each element, J/m^3.
Values mesh_error_density(const View& view) {
  const auto& errors = view.mesh_errors();
  const auto& terms = view.parts().elastic;
  Values out(view.parts().mesh.region_of.size());
  for (std::size_t r = 0; r < terms.size(); ++r)
    for (int k = 0; k < terms[r]->size(); ++k)
      out[static_cast<std::size_t>(terms[r]->cell(k))] +=
          errors[r].error[k] / errors[r].volume[k] * terms[r]->definition().share;
  return out;
}

// Energy of a region without the added terms that are loads, such as swelling, J.
double unloaded_energy(const ElasticTerm& term, const View& view) {
  double sum = term.energy(view.state());
  for (const AddedTerm* added : term.added())
    if (!added->is_load() && added->energy_kind() == EnergyKind::elastic) sum += added->energy(view.state());
  return sum;
}

// With swelling, a body may be strained without stress: the error is then compared with the energy that the strains
// would have without it.
Values mesh_error(const View& view) {
  Values out{0, 0};
  const auto& terms = view.parts().elastic;
  for (std::size_t r = 0; r < terms.size(); ++r) {
    const RegionMeshError& region = view.mesh_errors()[r];
    out[0] += region.error.sum();
    out[1] += terms[r]->added().empty() ? region.energy : std::max(region.energy, unloaded_energy(*terms[r], view));
  }
  return out;
}

FemOutput material_axis(int axis) {
  return {{"material_axis_" + std::to_string(axis + 1), Location::cell, 3, "1",
           "Material axis " + std::to_string(axis + 1) + ", rotated with the element."},
          [axis](const View& view) {
            return per_cell(view, 3, OfPlies::first, [&](const ElasticTerm& term, int k, double* out) {
              const Vec3 direction = term.observe(k, view.state()).axes.col(axis);
              std::copy(direction.begin(), direction.end(), out);
            });
          }};
}

Values angular_momentum(const View& view) {
  const NodalVector &p = view.momentum(), &x = view.nodal().x;
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < p.cols(); ++i) sum += x.col(i).cross(p.col(i));
  return flat(sum);
}

double dissipated_power(const View& view) {
  const auto& parts = view.parts();
  double power = parts.mass_damping > 0 ? 2 * parts.mass_damping * view.kinetic_energy() : 0;
  for (const Term* term : all_terms(parts)) power += term->dissipation(view.state());
  return power;
}

double load_power(const View& view) {
  const auto& parts = view.parts();
  double power = parts.moved ? view.support_forces().cwiseProduct(view.nodal().u_rate).sum() : 0;
  power += motor_power(parts, view.nodal(), view.multipliers());
  NodalState whole = view.state();
  whole.load_factor = 1;  // the sum is multiplied by it
  for (const auto& term : parts.loads) power += view.nodal().load_factor * term->load_power(whole);
  return power;
}

// Largest nodal force if the body were at rest in this shape, N.
double imbalance(const View& view) {
  const auto& parts = view.parts();
  const NodalExpansion& nodal = view.nodal();
  const Vector still = Vector::Zero(parts.dofs->num_dofs());
  Vector q(still.size()), free(still.size());
  parts.dofs->restrict_to(nodal.u, q);
  NodalExpansion resting(parts, nodal.time, q, still, nodal.load_factor);
  resting.internal = nodal.internal;
  free_forces(parts, resting, still, term_forces(parts, resting), free);
  NodalVector forces = NodalVector::Zero(3, nodal.x.cols());
  parts.dofs->add_forces_to(free, forces);
  if (!forces.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return forces.cols() > 0 ? std::sqrt(forces.colwise().squaredNorm().maxCoeff()) : 0;
}

Values smallest_det_f(const View& view) {
  Values out{std::numeric_limits<double>::infinity(), -1};
  for (const auto& term : view.parts().elastic)
    if (const auto [value, k] = term->smallest_det_F(view.state()); value < out[0])
      out = {value, static_cast<double>(term->cell(k))};
  return out;
}

Values largest_speed(const View& view) {
  const auto& subdomain = view.parts().subdomain;
  const NodalVector& v = view.nodal().u_rate;
  if (v.cols() == 0) return {0, 0};
  Eigen::Index node = 0;
  const double speed = std::sqrt(v.colwise().squaredNorm().maxCoeff(&node));
  return {speed, static_cast<double>(subdomain ? subdomain->nodes()[static_cast<std::size_t>(node)] : node)};
}

// The force (N) of a support at its node i.
Vec3 on(const Support& support, const NodalVector& forces, std::size_t i) {
  Vec3 force = Vec3::Zero();
  for (int c = 0; c < 3; ++c)
    if (support.held[i][static_cast<std::size_t>(c)]) force[c] = forces(c, support.nodes[i]);
  return force;
}

Vec3 middle_of(const NodalVector& places, const Subdomain* subdomain) {
  Eigen::Vector4d sums(places.row(0).sum(), places.row(1).sum(), places.row(2).sum(),
                       static_cast<double>(places.cols()));
  if (subdomain) subdomain->ranks().sum({sums.data(), 4});
  return sums.head<3>() / sums[3];
}

// Resultant of support_forces() on one support (N).
Vec3 reaction(const Support& support, const NodalVector& forces) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < support.nodes.size(); ++i) sum += on(support, forces, i);
  for (const int node : support.frames) sum += forces.col(node);
  return sum;
}

// Torque (N m) of support_forces() on one support, about the mean of its current node positions.
Vec3 reaction_torque(const Support& support, const NodalVector& forces, const NodalVector& x,
                     const Subdomain* subdomain) {
  const NodalVector places = x(Eigen::all, support.nodes);
  const Vec3 middle = middle_of(places, subdomain);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < support.nodes.size(); ++i)
    sum += (places.col(static_cast<Eigen::Index>(i)) - middle).cross(on(support, forces, i));
  for (const int node : support.frames) sum += (Vec3(x.col(node)) - middle).cross(Vec3(forces.col(node)));
  return sum;
}

FemOutput scalar(const std::string& name, const std::string& unit, const std::string& sentence,
                 const std::function<double(const View&)>& f, Reduction reduction = Reduction::sum) {
  return {{name, Location::global, 1, unit, sentence}, [f](const View& view) { return Values{f(view)}; }, reduction};
}

const std::vector<std::string>& axis_names() {
  static const std::vector<std::string> names{"x", "y", "z"};
  return names;
}

std::vector<FemOutput> make_outputs() {
  std::vector<FemOutput> all = {
      {{"displacement", Location::node, 3, "m", "Displacement from the rest shape."},
       [](const View& view) { return flat(view.nodal().u); },
       Reduction::sum,
       [](const View& view, int node) { return flat(Vec3(view.nodal().u.col(node))); }},
      {{"velocity", Location::node, 3, "m/s", "Velocity."},
       [](const View& view) { return flat(view.nodal().u_rate); },
       Reduction::sum,
       [](const View& view, int node) { return flat(Vec3(view.nodal().u_rate.col(node))); }},
      {{"region", Location::cell, 1, "1", "Index of the region."},
       [](const View& view) {
         const auto& regions = view.parts().mesh.region_of;
         if (!view.parts().subdomain) return Values(regions.begin(), regions.end());
         return per_cell(view, 1, OfPlies::first, [&](const ElasticTerm& term, int k, double* out) {
           *out = regions[static_cast<std::size_t>(term.cell(k))];
         });
       }},
      {{"det_f", Location::cell, 1, "1", "Volume ratio det F; not positive where inverted."},
       [](const View& view) {
         return per_cell(view, 1, OfPlies::smallest,
                         [&](const ElasticTerm& term, int k, double* out) { *out = term.det_F(k, view.state()); });
       }},
      material_axis(0),
      material_axis(1),
      material_axis(2),
      {{"mesh_error", Location::cell, 1, "J/m^3", "Estimated elastic energy of the discretisation error, per volume."},
       mesh_error_density},
      scalar("energy.kinetic", "J", "Kinetic energy.", [](const View& view) { return view.kinetic_energy(); }),
      scalar("energy.elastic", "J", "Elastic energy, including springs and contact.",
             [](const View& view) { return view.energy(EnergyKind::elastic); }),
      {{"energy.mesh_error", Location::global, 2, "J",
        "Estimated elastic energy of the discretisation error, and the elements' elastic energy."},
       mesh_error},
      scalar("energy.gravitational", "J", "Energy in the gravity field, zero at rest.",
             [](const View& view) { return view.energy(EnergyKind::gravitational); }),
      scalar("power.dissipated", "W", "Power dissipated by damping.", dissipated_power),
      scalar("power.loads", "W", "Power of loads and of moved supports.", load_power),
      scalar("imbalance", "N", "Largest nodal force if the body were at rest in this shape; 0 in equilibrium.",
             imbalance, Reduction::maximum),
      {{"det_f.smallest", Location::global, 2, "1", "Smallest det F, and its element."},
       smallest_det_f,
       Reduction::minimum},
      {{"speed.largest", Location::global, 2, "m/s", "Largest speed, and its node."},
       largest_speed,
       Reduction::maximum},
      {{"momentum.linear", Location::global, 3, "kg m/s", "Linear momentum of free and moved coordinates."},
       [](const View& view) { return flat(Vec3(view.momentum().rowwise().sum())); }},
      {{"momentum.angular", Location::global, 3, "kg m^2/s", "Angular momentum about the origin."}, angular_momentum},
  };
  for (FemOutput& output : all)
    if (output.info.components == 3) output.info.component_names = axis_names();
  const auto after =
      std::find_if(all.begin(), all.end(), [](const FemOutput& o) { return o.info.name == "mesh_error"; });
  std::vector<FemOutput> stresses;
  for (const TensorField& tensor : tensor_fields()) stresses.push_back(mean_of_cells(tensor));
  for (FemOutput& output : nodal_outputs({})) stresses.push_back(std::move(output));
  all.insert(after, stresses.begin(), stresses.end());
  return all;
}

}  // namespace

const std::vector<FemOutput>& all_outputs() {
  static const std::vector<FemOutput> all = make_outputs();
  return all;
}

std::vector<FemOutput> reaction_outputs(const std::vector<Support>& supports) {
  std::vector<FemOutput> out;
  for (const Support& support : supports) {
    out.push_back(
        {{"reaction." + support.name, Location::global, 3, "N", "Force of the support on the body.", axis_names()},
         [&support](const View& view) { return flat(reaction(support, view.support_forces())); }});
    out.push_back({{"torque." + support.name, Location::global, 3, "N m",
                    "Torque of the support on the body about the mean position of its nodes.", axis_names()},
                   [&support](const View& view) {
                     return flat(
                         reaction_torque(support, view.support_forces(), view.nodal().x, view.parts().subdomain.get()));
                   }});
  }
  return out;
}

std::vector<FemOutput> tie_outputs(const std::vector<NamedTie>& ties) {
  std::vector<FemOutput> out;
  for (const NamedTie& tie : ties)
    out.push_back({{"tie." + tie.name, Location::global, 3, "N",
                    "Force of the second surface of the tie on the first one.", axis_names()},
                   [&tie](const View& view) {
                     Vec3 sum = Vec3::Zero();
                     for (const TiedNode& tied : tie.nodes) sum += view.tie_forces().col(tied.node);
                     return flat(sum);
                   }});
  return out;
}

std::vector<FemOutput> contact_outputs(const std::vector<NamedContact>& contacts) {
  std::vector<FemOutput> out;
  for (const auto& [name, contact] : contacts) {
    if (contact->has_resultant())
      out.push_back({{"contact." + name, Location::global, 3, "N",
                      "Force of the contact on its first surface, or of the plane on the body.", axis_names()},
                     [contact = contact](const View& view) { return flat(contact->resultant(view.state())); }});
    out.push_back({{"contact_pressure." + name, Location::global, 1, "Pa", "Largest pressure of the contact."},
                   [contact = contact](const View& view) { return Values{contact->largest_pressure(view.state())}; },
                   Reduction::maximum});
  }
  return out;
}

namespace {

// `coordinate` must outlive the result.
FemOutput coordinate_output(const std::string& name, const JointCoordinate& coordinate) {
  const char* const sentence = coordinate.is_stretch() ? "Change of the distance of the two points of the joint."
                                                       : "Distance of the first body of the joint along the line.";
  return {{name, Location::global, 1, coordinate.unit(), sentence},
          [&coordinate](const View& view) { return Values{coordinate.value(view.nodal().u)}; }};
}

// `index`: of the angle among State::angles.
FemOutput angle_output(const std::string& name, const JointCoordinate& coordinate, Eigen::Index index) {
  return {{name, Location::global, 1, coordinate.unit(),
           "Angle of the first body of the joint about the line, with all turns."},
          [&coordinate, index](const View& view) {
            const double angle = coordinate.value(view.nodal().u);
            if (view.angles().size() == 0) return Values{angle};
            return Values{nearest_turns(Vector::Constant(1, angle), view.angles().segment(index, 1))[0]};
          }};
}

}  // namespace

std::vector<FemOutput> joint_outputs(const std::vector<Joint>& joints) {
  std::vector<FemOutput> out;
  for (const Joint& joint : joints) {
    if (joint.of != Joint::Of::bodies || !joint.holds()) continue;
    const auto reaction = [&joint](const View& view) {
      return joint_reaction(view.parts(), joint, view.nodal(), view.multipliers());
    };
    out.push_back(
        {{"joint." + joint.name, Location::global, 3, "N", "Force of the joint on its first body.", axis_names()},
         [reaction](const View& view) { return flat(reaction(view).force); }});
    if (joint.bears_torque())
      out.push_back({{"joint_torque." + joint.name, Location::global, 3, "N m",
                      "Torque of the joint on its first body about its point `at` or `from`.", axis_names()},
                     [reaction](const View& view) { return flat(reaction(view).torque); }});
  }
  Eigen::Index num_angles = 0;
  for (const Joint& joint : joints) {
    if (const JointCoordinate* turn = joint.turn()) {
      if (joint.coordinate->is_angle()) out.push_back(angle_output("coordinate." + joint.name, *turn, num_angles));
      if (joint.angle) out.push_back(angle_output("angle." + joint.name, *turn, num_angles));
      ++num_angles;
    }
    if (joint.coordinate && !joint.coordinate->is_angle())
      out.push_back(coordinate_output("coordinate." + joint.name, *joint.coordinate));
    if (joint.slide) out.push_back(coordinate_output("slide." + joint.name, *joint.slide));
    if (joint.motor())
      out.push_back({{"motor." + joint.name, Location::global, 1, joint.coordinate->is_angle() ? "N m" : "N",
                      "Force or torque of the joint's motor on its first body."},
                     [&joint](const View& view) {
                       return Values{motor_force(view.parts(), joint, view.nodal().time, view.multipliers())};
                     }});
  }
  if (std::none_of(joints.begin(), joints.end(), [](const Joint& joint) { return joint.holds(); })) return out;
  const auto largest = [](const View& view, bool of_rates) {
    const auto constraints = make_joint_constraints(view.parts());
    Vector q(view.parts().dofs->num_dofs()), v(q.size()), g(constraints->size());
    view.parts().dofs->restrict_to(view.nodal().u, q);
    view.parts().dofs->restrict_to(view.nodal().u_rate, v);
    if (of_rates) constraints->rates(view.nodal().time, q, v, g);
    else constraints->values(view.nodal().time, q, g);
    return std::vector<double>{g.cwiseAbs().maxCoeff()};
  };
  out.push_back({{"joints.gap", Location::global, 1, "m", "Largest distance of joined points, and change of rods."},
                 [largest](const View& view) { return largest(view, false); }});
  out.push_back({{"joints.rate", Location::global, 1, "m/s", "Largest rate of these distances."},
                 [largest](const View& view) { return largest(view, true); }});
  return out;
}

std::vector<OutputInfo> FemModel::outputs() const {
  std::vector<OutputInfo> infos;
  for (const auto& output : all_outputs()) infos.push_back(output.info);
  for (const auto& output : reaction_outputs(parts_.supports)) infos.push_back(output.info);
  for (const auto& output : joint_outputs(parts_.joints)) infos.push_back(output.info);
  for (const auto& output : tie_outputs(parts_.ties)) infos.push_back(output.info);
  for (const auto& output : contact_outputs(parts_.contacts)) infos.push_back(output.info);
  for (const FieldRegion& region : field_regions(parts_.elastic))
    for (OutputInfo info : region_fields()) {
      info.name = region.name + "." + info.name;
      infos.push_back(std::move(info));
    }
  return infos;
}

std::unique_ptr<StateView> FemModel::view(const State& state) const {
  return std::make_unique<FemStateView>(parts_, state);
}

std::vector<OutputInfo> region_fields() {
  std::vector<OutputInfo> infos;
  for (const FemOutput& output : nodal_outputs({})) infos.push_back(output.info);
  return infos;
}

}  // namespace orthodyn
