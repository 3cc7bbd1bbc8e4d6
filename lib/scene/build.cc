#include "lib/scene/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/fem/contact/contact.h"
#include "lib/fem/joint_start.h"
#include "lib/fem/terms/joint_load.h"
#include "lib/material_axes/axes_source.h"
#include "lib/scene/added_laws.h"
#include "lib/scene/elastic_parts.h"
#include "lib/scene/mesh_materials.h"
#include "lib/scene/rigid_regions.h"
#include "lib/scene/supports.h"

namespace orthodyn {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Names the outputs of a contact.
void add_contact(const Contact& contact, FemModel::Parts& parts) {
  const auto& [given, place] = contact.label();
  const std::string name = given.empty() ? fmt::format("contact_{}", parts.contacts.size() + 1) : given;
  require_name_for_csv(name, {place});
  for (const NamedContact& other : parts.contacts)
    if (other.name == name) throw ConfigError(place, fmt::format("name: '{}' is used twice among contacts", name));
  parts.contacts.push_back({name, &contact});
}

void add_force_terms(const Scene& scene, const NodalVector& rest, FemModel::Parts& parts) {
  const Discretization body{parts.mesh, rest, *parts.pattern, parts.mass->row_sums(), parts.mass->total()};
  for (const TermChoice* term : scene.force_terms()) {
    auto made = term->make(body);
    if (parts.subdomain) {
      parts.load_descriptions.push_back(made->description());
      auto part = made->part(*parts.subdomain);
      if (!part)
        throw ConfigError("terms", fmt::format("'{}' does not run on several ranks; run on one", made->name()));
      made = std::move(part);
    }
    if (const Contact* contact = made->contact()) add_contact(*contact, parts);
    parts.loads.push_back(std::move(made));
  }
}

// The next two functions restrict motions and supports to this rank, in its node numbering.
void restrict_to_rank(const Subdomain& subdomain, std::vector<MovedNodes::Part>& moved) {
  for (auto& part : moved) part.nodes = subdomain.here(part.nodes);
}

void restrict_to_rank(const Subdomain& subdomain, std::vector<Support>& supports) {
  for (Support& support : supports) {
    std::vector<std::array<bool, 3>> held;
    for (std::size_t i = 0; i < support.nodes.size(); ++i)
      if (subdomain.owns(support.nodes[i])) held.push_back(support.held[i]);
    support.nodes = subdomain.owned(support.nodes);
    support.held = std::move(held);
  }
}

void add_supports(Supports supports, const ElementMesh& elements, const MassSources& sources, const NodalVector& rest,
                  FemModel::Parts& parts) {
  if (parts.subdomain) {
    if (!supports.moved.empty()) parts.moved_everywhere = std::make_unique<MovedNodes>(supports.moved, rest);
    restrict_to_rank(*parts.subdomain, supports.moved);
    restrict_to_rank(*parts.subdomain, supports.named);
  }
  if (!supports.moved.empty()) parts.moved = std::make_unique<MovedNodes>(std::move(supports.moved), *parts.rest);
  parts.supports = std::move(supports.named);
  if (parts.moved || !parts.supports.empty())
    parts.support_mass = std::make_unique<SupportMass>(*parts.mass, elements, sources, *parts.dofs);
}

// Of the regions that are not rigid.
Traits traits_of(const Scene& scene, const std::vector<const Region*>& regions) {
  const auto is_damped = [&](const Region* r) { return stiffness_damping(scene, *r) > 0; };
  const auto all = [&](auto&& is) {
    return std::all_of(regions.begin(), regions.end(), [&](const Region* r) { return is(elasticity_of(scene, *r)); });
  };
  Traits traits;
  traits.linear = all([](const ElasticityOptions& e) { return e.kinematics == Kinematics::linear; });
  traits.damped = !regions.empty() && std::all_of(regions.begin(), regions.end(), is_damped);
  traits.damping_matrix = std::any_of(regions.begin(), regions.end(), is_damped);
  traits.lumped_mass = scene.mass == MassKind::lumped;
  traits.rigid = regions.empty();
  traits.free = scene.clamps.empty() && scene.motions.empty();
  traits.exact_stiffness = all([](const ElasticityOptions& e) { return e.has_exact_tangent(); });
  traits.dissipative = traits.damping_matrix || (scene.damping && scene.damping->mass > 0);
  traits.conservative = !traits.dissipative && all([](const ElasticityOptions& e) { return !e.is_warped(); });
  declare_added_laws(scene, regions, traits);
  for (const SupportMotion& motion : scene.motions) motion.declare(traits);
  for (const TermChoice* term : scene.force_terms()) term->declare(traits);
  for (const JointInput& joint : scene.joints) joint.declare(traits);
  return traits;
}

void require_no_internal_variables(const Scene& scene, const std::vector<const Region*>& regions) {
  for (const Region* region : regions)
    for (const std::string& material : region->materials())
      if (is_viscoelastic(material_named(scene, material)))
        region->origin.fail(
            fmt::format("the viscoelastic material '{}' is not available on several ranks; run on one", material));
}

NodePairs couplings(const Scene& scene, const Mesh& mesh) {
  NodePairs all;
  for (const TermChoice* term : scene.force_terms())
    for (const auto& pair : term->couplings(mesh)) all.push_back(pair);
  return all;
}

// Volumes, shape gradients and their squares must not overflow or underflow.
void require_size(const Mesh& mesh) {
  constexpr double kSmallest = 1e-50, kLargest = 1e50;
  const Box box = bounding_box(mesh);
  const double smallest = box.size().minCoeff();
  const double largest = std::max(box.min.lpNorm<Eigen::Infinity>(), box.max.lpNorm<Eigen::Infinity>());
  if (smallest >= kSmallest && largest <= kLargest) return;
  throw ConfigError("mesh", fmt::format("extends from {} to {} m; extents must be at least {:.0e} m and coordinates at "
                                        "most {:.0e} m; check the unit of length",
                                        Value<Vec3>::yaml(box.min), Value<Vec3>::yaml(box.max), kSmallest, kLargest));
}

// Warns if the mesh file has element axes, but all regions have uniform axes and one has a material that is not
// isotropic.
void warn_of_unused_axes(const Scene& scene, const std::vector<const Region*>& regions,
                         const std::vector<CellData>& data, Warnings& warnings) {
  const auto is_first_axis = [](const CellData& d) { return d.name == "axis_1" && d.components == 3; };
  if (std::none_of(data.begin(), data.end(), is_first_axis)) return;
  for (const Region* region : regions)
    if (!region->axes->uniform()) return;
  const auto is_isotropic = [&](const std::string& material) {
    return std::holds_alternative<IsotropicStiffness>(material_named(scene, material).stiffness());
  };
  for (const Region* region : regions) {
    const std::vector<std::string> materials = region->materials();
    if (std::all_of(materials.begin(), materials.end(), is_isotropic)) continue;
    warnings.push_back(region->origin.where +
                       ": the mesh file has element axes, which the scene does not use; if they are material axes, set "
                       "axes: {type: file, file: the mesh file} for the regions");
    return;
  }
}

// Warns that element means hide variation, such as bending of one quadratic element through the thickness.
void add_note_on_means(const Scene& scene, const Mesh& mesh, Warnings& warnings) {
  if (mesh.order() == 1) return;
  for (const std::string& field : scene.output.fields)
    if (field == "strain" || field == "stress" || field == "stress_material")
      warnings.push_back(
          fmt::format("output.fields: '{0}' of a quadratic element is its mean, which hides the variation within the "
                      "element; nodal_{0} shows it",
                      field));
}

// Reports the changes that materials made to their input.
void add_notes(const Scene& scene, Warnings& warnings) {
  for (const auto& [name, material] : scene.materials)
    for (const auto& note : material->notes()) warnings.push_back(fmt::format("material {}: {}", name, note));
}

NodalVector positions(const Mesh& mesh) {
  NodalVector rest(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (Eigen::Index i = 0; i < rest.cols(); ++i) rest.col(i) = mesh.nodes[static_cast<std::size_t>(i)];
  return rest;
}

void require_free_coordinates(const Scene& scene, const std::vector<bool>& held) {
  if (std::all_of(held.begin(), held.end(), [](bool is_held) { return is_held; }))
    (scene.clamps.empty() ? scene.motions.front().origin : scene.clamps.front().origin)
        .fail("all nodes are clamped or moved: nothing is left to compute");
}

void require_mass(double mass) {
  if (!std::isnormal(mass))
    throw ConfigError(
        "mesh",
        fmt::format("its mass is {:.3g} kg, outside the range of numbers; check density and unit of length", mass));
}

// Several ranks support lumped masses only.
void require_divisible(const Scene& scene) {
  if (scene.mass == MassKind::consistent)
    throw ConfigError("mass", "consistent does not run on several ranks; set `mass: lumped`");
}

// Index of each of this rank's unknowns in the model on one rank.
std::vector<int> unknowns_of(const Subdomain& subdomain, const std::vector<bool>& held) {
  std::vector<int> number;
  int count = 0;
  for (const bool is_held : held) number.push_back(is_held ? -1 : count++);
  std::vector<int> out;
  for (int i = 0; i < subdomain.num_owned(); ++i)
    for (int c = 0; c < 3; ++c)
      if (const int n = number[at(3 * subdomain.nodes()[at(i)] + c)]; n >= 0) out.push_back(n);
  return out;
}

std::vector<double> cells_here(const std::vector<double>& of_all, const Subdomain& subdomain) {
  std::vector<double> out;
  for (const int cell : subdomain.cells()) out.push_back(of_all[at(cell)]);
  return out;
}

NodePairs pairs_here(const NodePairs& pairs, const Subdomain& subdomain) {
  NodePairs here;
  for (const auto& [a, b] : pairs)
    if (subdomain.local(a) >= 0 && subdomain.local(b) >= 0) here.emplace_back(subdomain.local(a), subdomain.local(b));
  return here;
}

// Rigid regions do not deform.
std::vector<const Region*> deformable_of(std::vector<const Region*> regions) {
  std::erase_if(regions, [](const Region* region) { return region->rigid.is_rigid; });
  return regions;
}

void require_no_ties(const Scene& scene, const std::vector<RigidBody>& rigid) {
  if (!scene.ties.empty()) scene.ties.front().origin.fail("ties are not available on several ranks; run on one");
  if (!rigid.empty())
    throw ConfigError(rigid.front().place, "rigid regions are not available on several ranks; run on one");
}

std::vector<Joint> joints_of(const Scene& scene, const Mesh& mesh, const std::vector<RigidBody>& rigid,
                             const Ranks* ranks) {
  std::vector<Joint> joints;
  for (const JointInput& joint : scene.joints) {
    if (scene.start == Start::equilibrium)
      joint.origin.fail("joints are not available with start: equilibrium; start at rest, and let loads rise slowly");
    if (ranks) joint.origin.fail("joints are not available on several ranks; run on one");
    for (const Joint& other : joints)
      if (other.name == joint.name) joint.origin.fail(fmt::format("name: '{}' is used twice among joints", joint.name));
    joints.push_back(joint.on(mesh, rigid, scene.time.start, scene.time.end));
  }
  return joints;
}

// `joints` and Parts::joints have the joints of the scene first, in its order; the constraints of rigid bodies follow.
void add_joint_couplings(const Scene& scene, const std::vector<Joint>& joints, NodePairs& pairs) {
  for (std::size_t k = 0; k < scene.joints.size(); ++k) {
    if (!scene.joints[k].has_forces()) continue;
    const NodePairs own = CoordinateNodes(*joints[k].coordinate).pairs();
    pairs.insert(pairs.end(), own.begin(), own.end());
  }
}

void add_joint_forces(const Scene& scene, FemModel::Parts& parts) {
  for (std::size_t k = 0; k < scene.joints.size(); ++k) {
    const JointInput& joint = scene.joints[k];
    const auto& coordinate = parts.joints[k].coordinate;
    if (const JointLaw law = joint.law(); law.acts())
      parts.loads.push_back(joint_forces_term(joint.name, *coordinate, law, *parts.pattern));
    if (joint.load)
      parts.loads.push_back(
          joint_load_term(joint.name, *coordinate, joint.load->amount, joint.load->factor, *parts.pattern));
  }
}

// Makes the initial velocities fit the joints.
void fit_joints(const Scene& scene, BuiltScene& built) {
  constexpr double kTold = 1e-6;       // relative to the largest velocity
  constexpr double kRoundOff = 1e-12;  // relative to the mesh's extent over the duration
  const double extent = bounding_box(built.model->parts().mesh).size().maxCoeff();
  const double least = kRoundOff * extent / (scene.time.end - scene.time.start);
  const double largest = built.initial.v.lpNorm<Eigen::Infinity>();
  const double changed = start_consistently(*built.model, built.initial);
  if (changed > std::max(kTold * largest, least))
    built.warnings.push_back(
        fmt::format("{}: the joints forbid the initial velocities; the run starts with the nearest ones that they "
                    "allow, which differ by "
                    "up to {:.3g} m/s",
                    scene.initial ? scene.initial->origin.where : built.model->parts().joints.front().place, changed));
}

BuiltScene build_model(const Scene& scene, const Ranks* ranks, MatrixStorage storage) {
  LoadedMesh loaded = load_mesh(scene);
  FemModel::Parts parts;
  parts.mesh = std::move(loaded.mesh);
  require_size(parts.mesh);
  const auto regions = assign_regions(scene, parts.mesh);
  const auto deformable = deformable_of(regions);
  parts.rigid_bodies = rigid_bodies(regions, parts.mesh);
  TiedSurfaces tied = make_ties(scene.ties, parts.rigid_bodies, parts.mesh, loaded.warnings);
  if (ranks) require_no_ties(scene, parts.rigid_bodies);
  if (ranks) require_divisible(scene);
  warn_of_unused_axes(scene, deformable, loaded.cell_data, loaded.warnings);
  ElasticParts elastic = elastic_parts(scene, regions, parts.mesh, loaded.warnings);
  add_inertia(parts.mesh, elastic.density, parts.rigid_bodies);
  Supports supports = make_supports(scene, parts.mesh);
  hold_rigid_bodies(scene, parts.mesh, parts.rigid_bodies, supports);
  require_dynamic(scene, parts.rigid_bodies);
  release_tied_nodes(scene.ties, tied, parts.mesh, supports);
  parts.ties = std::move(tied.named);
  require_free_coordinates(scene, supports.held);
  parts.joints = joints_of(scene, parts.mesh, parts.rigid_bodies, ranks);
  NodePairs pairs = couplings(scene, parts.mesh);
  add_joint_couplings(scene, parts.joints, pairs);

  Mesh part;  // several ranks: this rank's part of the mesh
  if (ranks) {
    parts.subdomain = std::make_unique<Subdomain>(parts.mesh, pairs, *ranks);
    part = parts.subdomain->part_of(parts.mesh);
    parts.unknowns = unknowns_of(*parts.subdomain, supports.held);
    supports.held = parts.subdomain->coordinates_here(supports.held);
    pairs = pairs_here(pairs, *parts.subdomain);
  }
  const Subdomain* subdomain = parts.subdomain.get();
  const Mesh& own = subdomain ? part : parts.mesh;
  const int num_nodes = static_cast<int>(own.nodes.size());
  parts.dofs = std::make_unique<DofMap>(num_nodes, supports.held, subdomain ? subdomain->num_owned() : num_nodes,
                                        std::move(tied.ties));
  const bool symmetric = storage == MatrixStorage::by_elasticity &&
                         std::all_of(deformable.begin(), deformable.end(),
                                     [&](const Region* r) { return elasticity_of(scene, *r).has_symmetric_tangent(); });
  const ElementMesh elements(own, &parts.dofs->ties());
  parts.pattern = std::make_unique<BlockPattern>(elements.cells, *parts.dofs, symmetric, pairs);
  if (subdomain) parts.pattern->set_share(*subdomain);
  const MassSources masses(subdomain ? cells_here(elastic.density, *subdomain) : elastic.density,
                           frame_masses(parts.rigid_bodies, parts.mesh));
  parts.mass = std::make_unique<Mass>(scene.mass, elements, masses, *parts.dofs, *parts.pattern, subdomain);
  require_mass(parts.mass->total());
  if (!parts.ties.empty() && !parts.mass->lumped())
    parts.tied_mass = std::make_unique<TiedMass>(elements, masses.density, parts.dofs->ties());
  const NodalVector rest = positions(parts.mesh);
  parts.rest = std::make_unique<NodalVector>(positions(own));
  add_supports(std::move(supports), elements, masses, rest, parts);
  parts.mass_damping = scene.damping ? scene.damping->mass : 0;
  parts.traits = traits_of(scene, deformable);
  if (scene.is_static() && scene.analysis != Analysis::harmonic) parts.loads_at = scene.time.end;
  if (subdomain) require_no_internal_variables(scene, deformable);
  for (const RigidBody& body : parts.rigid_bodies)
    if (!body.is_held) parts.joints.push_back(body.rigidity(parts.mesh));
  auto added = add_elasticity(scene, std::move(elastic), elements, parts);
  add_force_terms(scene, rest, parts);
  add_joint_forces(scene, parts);
  for (auto& term : added) {
    if (parts.subdomain) parts.load_descriptions.push_back(term->description());
    parts.loads.push_back(std::move(term));
  }
  BuiltScene built{std::make_unique<FemModel>(std::move(parts)), {}, std::move(loaded.warnings)};
  add_notes(scene, built.warnings);
  add_note_on_means(scene, built.model->parts().mesh, built.warnings);
  built.initial = initial_state(scene.initial, scene.time.start, *built.model);
  fit_joints(scene, built);
  return built;
}

}  // namespace

bool has_unsymmetric_load(const Scene& scene, const Mesh& mesh) {
  const auto terms = scene.force_terms();
  const std::vector<bool> held = make_supports(scene, mesh).held;
  return std::any_of(terms.begin(), terms.end(),
                     [&](const TermChoice* term) { return !term->has_symmetric_tangent(mesh, held); });
}

BuiltScene build(const Scene& scene, const Ranks* ranks, MatrixStorage storage) {
  return scene.places.with([&] { return build_model(scene, ranks, storage); });
}

}  // namespace orthodyn
