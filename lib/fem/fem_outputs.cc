// The named fields and scalars of a FemModel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "lib/fem/fem_state_view.h"
#include "lib/fem/nodal_fields.h"
#include "lib/fem/reactions.h"
#include "lib/fem/whole_fields.h"

namespace orthodyn {

namespace {

using View = FemStateView;
using Values = std::vector<double>;

// How per-rank values are reduced. `smallest` and `largest`: by the first value; a second one is the place of the
// first. `same`: all ranks have the same values.
enum class Together { sum, smallest, largest, same };

struct Output {
  OutputInfo info;
  std::function<Values(const View&)> compute;
  Together together = Together::sum;
};

template <class M>
Values flat(const M& m) {
  return Values(m.data(), m.data() + m.size());
}

// One value set per cell of the mesh, from its elastic term.
Values per_cell(const View& view, std::size_t components,
                const std::function<void(const ElasticTerm&, int k, double* out)>& f) {
  Values out(view.parts().mesh.region_of.size() * components);
  for (const auto& term : view.parts().elastic)
    for (int k = 0; k < term->size(); ++k)
      f(*term, k, out.data() + static_cast<std::size_t>(term->cell(k)) * components);
  return out;
}

Output mean_of_cells(const TensorField& tensor) {
  return {{tensor.name, Location::cell, 6, tensor.unit, fmt::format("{}. Mean of an element.", tensor.sentence),
           tensor.components},
          [&tensor](const View& view) {
            return per_cell(view, 6, [&](const ElasticTerm& term, int k, double* out) {
              const Vec6 v = tensor(term.observe(k, view.state()));
              std::copy(v.begin(), v.end(), out);
            });
          }};
}

constexpr int kAllRegions = -1;

Output at_nodes(const TensorField& tensor, int region = kAllRegions) {
  return {{fmt::format("nodal_{}", tensor.name), Location::node, 6, tensor.unit,
           fmt::format("{}. Recovered at the nodes.", tensor.sentence), tensor.components},
          [&tensor, region](const View& view) { return tensor_at_nodes(view.recovered(), tensor, region); },
          Together::same};
}

Output at_nodes(const DerivedField& derived, int region = kAllRegions) {
  const auto count = static_cast<int>(std::max<std::size_t>(derived.components.size(), 1));
  return {{derived.name, Location::node, count, derived.unit, derived.sentence, derived.components},
          [&derived, region](const View& view) {
            return derived_at_nodes(view.recovered(), view.parts().elastic, derived, region);
          },
          Together::same};
}

// Of stress and strain at the nodes of one region, or of all.
std::vector<Output> nodal_outputs(int region) {
  std::vector<Output> out;
  for (const TensorField& tensor : tensor_fields()) out.push_back(at_nodes(tensor, region));
  for (const DerivedField& derived : derived_fields()) out.push_back(at_nodes(derived, region));
  return out;
}

// Of each element the energy of the error for its volume, J/m^3.
Values mesh_error_density(const View& view) {
  const auto& errors = view.mesh_errors();
  const auto& terms = view.parts().elastic;
  Values out(view.parts().mesh.region_of.size());
  for (std::size_t r = 0; r < terms.size(); ++r)
    for (int k = 0; k < terms[r]->size(); ++k)
      out[static_cast<std::size_t>(terms[r]->cell(k))] = errors[r].error[k] / errors[r].volume[k];
  return out;
}

Values mesh_error(const View& view) {
  Values out{0, 0};
  for (const RegionMeshError& region : view.mesh_errors()) {
    out[0] += region.error.sum();
    out[1] += region.energy;
  }
  return out;
}

Output material_axis(int axis) {
  return {{"material_axis_" + std::to_string(axis + 1), Location::cell, 3, "1",
           "Material axis " + std::to_string(axis + 1) + ", rotated with the element."},
          [axis](const View& view) {
            return per_cell(view, 3, [&](const ElasticTerm& term, int k, double* out) {
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
  for (const auto& term : parts.elastic) power += term->dissipation(view.state());
  for (const auto& term : parts.loads) power += term->dissipation(view.state());
  return power;
}

double load_power(const View& view) {
  const auto& parts = view.parts();
  double power = parts.moved ? view.support_forces().cwiseProduct(view.nodal().u_rate).sum() : 0;
  for (const auto& term : parts.loads) power += view.nodal().load_factor * term->load_power(view.state());
  return power;
}

// The largest force on a node, were the body at rest in this shape.
double imbalance(const View& view) {
  const auto& parts = view.parts();
  const NodalExpansion& nodal = view.nodal();
  const Vector still = Vector::Zero(parts.dofs->num_dofs());
  Vector q(still.size()), free(still.size());
  parts.dofs->restrict_to(nodal.u, q);
  const NodalExpansion resting(parts, nodal.time, q, still, nodal.load_factor);
  free_forces(parts, resting, still, term_forces(parts, resting), free);
  NodalVector forces = NodalVector::Zero(3, nodal.x.cols());
  parts.dofs->add_to(free, forces);
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

Output scalar(const std::string& name, const std::string& unit, const std::string& sentence,
              const std::function<double(const View&)>& f, Together together = Together::sum) {
  return {{name, Location::global, 1, unit, sentence}, [f](const View& view) { return Values{f(view)}; }, together};
}

const std::vector<std::string>& axis_names() {
  static const std::vector<std::string> names{"x", "y", "z"};
  return names;
}

std::vector<Output> make_outputs() {
  std::vector<Output> all = {
      {{"displacement", Location::node, 3, "m", "Displacement from the rest shape."},
       [](const View& view) { return flat(view.nodal().u); }},
      {{"velocity", Location::node, 3, "m/s", "Velocity."}, [](const View& view) { return flat(view.nodal().u_rate); }},
      {{"region", Location::cell, 1, "1", "Index of the region."},
       [](const View& view) {
         const auto& regions = view.parts().mesh.region_of;
         return per_cell(view, 1, [&](const ElasticTerm& term, int k, double* out) {
           *out = regions[static_cast<std::size_t>(term.cell(k))];
         });
       }},
      {{"det_f", Location::cell, 1, "1", "Volume ratio det F; not positive where inverted."},
       [](const View& view) {
         return per_cell(view, 1,
                         [&](const ElasticTerm& term, int k, double* out) { *out = term.det_F(k, view.state()); });
       }},
      material_axis(0),
      material_axis(1),
      material_axis(2),
      {{"mesh_error", Location::cell, 1, "J/m^3", "Estimated elastic energy of the mesh's error, per volume."},
       mesh_error_density},
      scalar("energy.kinetic", "J", "Kinetic energy.", [](const View& view) { return view.kinetic_energy(); }),
      scalar("energy.elastic", "J", "Elastic energy, that of springs and of contact included.",
             [](const View& view) { return view.energy(EnergyKind::elastic); }),
      {{"energy.mesh_error", Location::global, 2, "J",
        "Estimated elastic energy of the mesh's error, and the elements' elastic energy."},
       mesh_error},
      scalar("energy.gravitational", "J", "Energy in the gravity field, zero at rest.",
             [](const View& view) { return view.energy(EnergyKind::gravitational); }),
      scalar("power.dissipated", "W", "Power taken by damping.", dissipated_power),
      scalar("power.loads", "W", "Power of loads and of moved supports.", load_power),
      scalar("imbalance", "N", "The largest force on a node, were the body at rest in this shape; 0 in equilibrium.",
             imbalance, Together::largest),
      {{"det_f.smallest", Location::global, 2, "1", "The smallest det F, and the element that has it."},
       smallest_det_f,
       Together::smallest},
      {{"speed.largest", Location::global, 2, "m/s", "The largest speed, and the node that has it."},
       largest_speed,
       Together::largest},
      {{"momentum.linear", Location::global, 3, "kg m/s",
        "Linear momentum of the free coordinates, and of moved ones."},
       [](const View& view) { return flat(Vec3(view.momentum().rowwise().sum())); }},
      {{"momentum.angular", Location::global, 3, "kg m^2/s", "Angular momentum about the origin."}, angular_momentum},
  };
  for (Output& output : all)
    if (output.info.components == 3) output.info.component_names = axis_names();
  const auto after = std::find_if(all.begin(), all.end(), [](const Output& o) { return o.info.name == "mesh_error"; });
  std::vector<Output> stresses;
  for (const TensorField& tensor : tensor_fields()) stresses.push_back(mean_of_cells(tensor));
  for (Output& output : nodal_outputs(kAllRegions)) stresses.push_back(std::move(output));
  all.insert(after, stresses.begin(), stresses.end());
  return all;
}

const std::vector<Output>& all_outputs() {
  static const std::vector<Output> all = make_outputs();
  return all;
}

// Of the supports whose reactions are wanted.
std::vector<Output> reaction_outputs(const std::vector<Support>& supports) {
  std::vector<Output> out;
  for (const Support& support : supports) {
    out.push_back(
        {{"reaction." + support.name, Location::global, 3, "N", "Force of the support on the body.", axis_names()},
         [&support](const View& view) { return flat(reaction(support, view.support_forces())); }});
    out.push_back({{"torque." + support.name, Location::global, 3, "N m", "Its torque about the middle of the nodes.",
                    axis_names()},
                   [&support](const View& view) {
                     return flat(
                         reaction_torque(support, view.support_forces(), view.nodal().x, view.parts().subdomain.get()));
                   }});
  }
  return out;
}

}  // namespace

std::vector<OutputInfo> FemModel::outputs() const {
  std::vector<OutputInfo> infos;
  for (const auto& output : all_outputs()) infos.push_back(output.info);
  for (const auto& output : reaction_outputs(parts_.supports)) infos.push_back(output.info);
  for (const auto& term : parts_.elastic)
    for (OutputInfo info : region_fields()) {
      info.name = term->region() + "." + info.name;
      infos.push_back(std::move(info));
    }
  return infos;
}

std::unique_ptr<StateView> FemModel::view(const State& state) const {
  return std::make_unique<FemStateView>(parts_, state);
}

namespace {

// "REGION.FIELD": a field of stress or strain at the nodes of one region, NaN elsewhere.
std::vector<double> evaluate_in_region(const View& view, const std::string& name) {
  const auto& terms = view.parts().elastic;
  for (std::size_t r = 0; r < terms.size(); ++r) {
    const std::string prefix = terms[r]->region() + ".";
    if (!name.starts_with(prefix)) continue;
    for (const Output& output : nodal_outputs(static_cast<int>(r)))
      if (prefix + output.info.name == name) return output.compute(view);
  }
  throw std::logic_error("no output named " + name);
}

}  // namespace

std::vector<OutputInfo> region_fields() {
  std::vector<OutputInfo> infos;
  for (const Output& output : nodal_outputs(kAllRegions)) infos.push_back(output.info);
  return infos;
}

namespace {

// NaN of one rank is that of all.
Values extreme_of_ranks(const Ranks& ranks, Values here, double sign) {
  if (ranks.any(std::isnan(here[0]))) {
    here[0] = std::numeric_limits<double>::quiet_NaN();
    return here;
  }
  const double extreme = ranks.max(sign * here[0]);
  if (here.size() > 1) here[1] = -ranks.max(sign * here[0] == extreme ? -here[1] : -1e300);  // the first place
  here[0] = sign * extreme;
  return here;
}

Values of_all_ranks(const FemModel::Parts& parts, const Output& output, Values here) {
  const Ranks& ranks = parts.subdomain->ranks();
  if (output.together == Together::same) return here;
  if (output.together == Together::smallest) return extreme_of_ranks(ranks, std::move(here), -1);
  if (output.together == Together::largest) return extreme_of_ranks(ranks, std::move(here), 1);
  if (output.info.location == Location::node)
    return on_all_nodes(*parts.subdomain, here, static_cast<std::size_t>(output.info.components),
                        parts.mesh.nodes.size());
  ranks.sum(here);
  return here;
}

}  // namespace

std::vector<double> FemStateView::evaluate(const std::string& name) const {
  const auto evaluated = [&](const Output& output) {
    Values here = output.compute(*this);
    return parts_.subdomain ? of_all_ranks(parts_, output, std::move(here)) : here;
  };
  for (const auto& output : all_outputs())
    if (output.info.name == name) return evaluated(output);
  for (const auto& output : reaction_outputs(parts_.supports))
    if (output.info.name == name) return evaluated(output);
  return evaluate_in_region(*this, name);
}

}  // namespace orthodyn
