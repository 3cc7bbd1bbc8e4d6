#include "lib/scene/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/axes/axes_source.h"
#include "lib/fem/elastic_region.h"
#include "lib/fem/element_groups.h"
#include "lib/scene/mesh_materials.h"
#include "lib/scene/supports.h"

namespace orthodyn {

namespace {

double stiffness_damping(const Scene& scene, const Region& region) {
  return region.stiffness_damping.value_or(scene.damping ? scene.damping->stiffness : 0);
}

std::vector<double> densities(const Scene& scene, const TetMesh& mesh, const std::vector<const Region*>& regions) {
  std::vector<double> out;
  for (const int r : mesh.region_of)
    out.push_back(material_of(scene, *regions[static_cast<std::size_t>(r)]).density());
  return out;
}

void add_elasticity(const Scene& scene, const std::vector<const Region*>& regions, const ElementMesh& elements,
                    FemModel::Parts& parts, Warnings& notes) {
  const TetMesh& mesh = parts.mesh;
  std::map<const Region*, AxesField> fields;  // one entry of the scene may describe several regions of the mesh
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = *regions[r];
    std::vector<int> cells;
    for (std::size_t e = 0; e < mesh.tets.size(); ++e)
      if (mesh.region_of[e] == static_cast<int>(r)) cells.push_back(static_cast<int>(e));
    if (cells.empty()) continue;
    cells = by_place(elements, std::move(cells));
    AxesField& field = fields[&region];
    if (!field) field = region.axes->field(mesh, notes);
    const ElementAxes axes = element_axes(*region.axes, field, elements, cells);
    parts.elastic.push_back(elements.type.elastic_term(
        elements, {mesh.region_names[r], std::move(cells), material_of(scene, region).stiffness(), axes,
                   stiffness_damping(scene, region), elasticity_of(scene, region),
                   material_of(scene, region).strength()}, *parts.pattern));
    parts.densities.push_back(material_of(scene, region).density());
  }
}

void add_force_terms(const Scene& scene, FemModel::Parts& parts) {
  const Discretization body{parts.mesh, *parts.rest, *parts.pattern, parts.mass->row_sums()};
  for (const TermChoice* term : scene.force_terms()) parts.loads.push_back(term->make(body));
}

void add_supports(Supports supports, const ElementMesh& elements, const std::vector<double>& density,
                  FemModel::Parts& parts) {
  if (!supports.moved.empty()) parts.moved = std::make_unique<MovedNodes>(std::move(supports.moved), *parts.rest);
  parts.supports = std::move(supports.named);
  if (parts.moved || !parts.supports.empty())
    parts.support_mass = std::make_unique<SupportMass>(*parts.mass, elements, density, *parts.dofs);
}

Traits traits_of(const Scene& scene, const std::vector<const Region*>& regions) {
  const auto is_damped = [&](const Region* r) { return stiffness_damping(scene, *r) > 0; };
  const auto all = [&](auto&& is) {
    return std::all_of(regions.begin(), regions.end(), [&](const Region* r) { return is(elasticity_of(scene, *r)); });
  };
  Traits traits;
  traits.linear = all([](const ElasticityOptions& e) { return e.kinematics == Kinematics::linear; });
  traits.damped = std::all_of(regions.begin(), regions.end(), is_damped);
  traits.damping_matrix = std::any_of(regions.begin(), regions.end(), is_damped);
  traits.lumped_mass = scene.mass == MassKind::lumped;
  traits.exact_stiffness = all([](const ElasticityOptions& e) { return e.has_exact_tangent(); });
  traits.dissipative = traits.damping_matrix || (scene.damping && scene.damping->mass > 0);
  traits.conservative = !traits.dissipative && all([](const ElasticityOptions& e) { return !e.is_warped(); });
  for (const SupportMotion& motion : scene.motions) motion.declare(traits);
  for (const TermChoice* term : scene.force_terms()) term->declare(traits);
  return traits;
}

NodePairs couplings(const Scene& scene, const TetMesh& mesh) {
  NodePairs all;
  for (const TermChoice* term : scene.force_terms())
    for (const auto& pair : term->couplings(mesh)) all.push_back(pair);
  return all;
}

// Volumes and gradients of shapes, and their squares, must be numbers.
void require_size(const TetMesh& mesh) {
  constexpr double kSmallest = 1e-50, kLargest = 1e50;
  const Box box = bounding_box(mesh);
  const double smallest = box.size().minCoeff();
  const double largest = std::max(box.min.lpNorm<Eigen::Infinity>(), box.max.lpNorm<Eigen::Infinity>());
  if (smallest >= kSmallest && largest <= kLargest) return;
  throw ConfigError("mesh",
                    fmt::format("it extends from {} to {} m; extents below {:.0e} m and coordinates beyond {:.0e} m "
                                "cannot be computed with; check the unit of length",
                                Value<Vec3>::yaml(box.min), Value<Vec3>::yaml(box.max), kSmallest, kLargest));
}

// Axes that the mesh file has for its elements, of a material that has directions.
void warn_of_unused_axes(const Scene& scene, const std::vector<const Region*>& regions,
                         const std::vector<CellData>& data, Warnings& warnings) {
  const auto is_first_axis = [](const CellData& d) { return d.name == "axis_1" && d.components == 3; };
  if (std::none_of(data.begin(), data.end(), is_first_axis)) return;
  for (const Region* region : regions)
    if (!region->axes->uniform()) return;
  for (const Region* region : regions) {
    if (std::holds_alternative<IsotropicStiffness>(material_of(scene, *region).stiffness())) continue;
    warnings.push_back(region->origin.where + ": the mesh file has axes of its elements, which the scene does not use; "
                       "if they are those of the material, give regions axes: {type: file, file: the mesh file}");
    return;
  }
}

// With one quadratic element through a thickness its mean is blind for bending.
void add_note_on_means(const Scene& scene, const TetMesh& mesh, Warnings& warnings) {
  if (mesh.order() == 1) return;
  for (const std::string& field : scene.output.fields)
    if (field == "strain" || field == "stress" || field == "stress_material")
      warnings.push_back(fmt::format("output.fields: '{0}' of a quadratic element is its mean, which hides how it "
                                     "varies within; nodal_{0} shows it",
                                     field));
}

// What the materials had to change of the input.
void add_notes(const Scene& scene, Warnings& warnings) {
  for (const auto& [name, material] : scene.materials)
    for (const auto& note : material->notes()) warnings.push_back(fmt::format("material {}: {}", name, note));
}

}  // namespace

BuiltScene build(const Scene& scene) {
  LoadedMesh loaded = load_mesh(scene);
  FemModel::Parts parts;
  parts.mesh = std::move(loaded.mesh);
  require_size(parts.mesh);
  const auto regions = assign_regions(scene, parts.mesh);
  warn_of_unused_axes(scene, regions, loaded.cell_data, loaded.warnings);
  Supports supports = make_supports(scene, parts.mesh);
  const int num_nodes = static_cast<int>(parts.mesh.nodes.size());
  parts.dofs = std::make_unique<DofMap>(num_nodes, supports.held);
  if (parts.dofs->num_dofs() == 0)
    (scene.clamps.empty() ? scene.motions.front().origin : scene.clamps.front().origin)
        .fail("all nodes are clamped or moved: nothing is left to compute");
  const bool symmetric = std::all_of(regions.begin(), regions.end(), [&](const Region* r) {
    return elasticity_of(scene, *r).has_symmetric_tangent();
  });
  const ElementMesh elements(parts.mesh);
  parts.pattern = std::make_unique<BlockPattern>(elements.cells, *parts.dofs, symmetric, couplings(scene, parts.mesh));
  const auto density = densities(scene, parts.mesh, regions);
  parts.mass = std::make_unique<Mass>(scene.mass, elements, density, *parts.dofs, *parts.pattern);
  if (!std::isnormal(parts.mass->total()))
    throw ConfigError("mesh",
                      fmt::format("its mass is {:.3g} kg, with which nothing can be computed; check density and "
                                  "unit of length",
                                  parts.mass->total()));
  parts.rest = std::make_unique<NodalVector>(3, num_nodes);
  for (int i = 0; i < num_nodes; ++i) parts.rest->col(i) = parts.mesh.nodes[static_cast<std::size_t>(i)];
  add_supports(std::move(supports), elements, density, parts);
  parts.mass_damping = scene.damping ? scene.damping->mass : 0;
  parts.traits = traits_of(scene, regions);
  if (scene.is_static()) parts.loads_at = scene.time.end;
  add_elasticity(scene, regions, elements, parts, loaded.warnings);
  add_force_terms(scene, parts);
  BuiltScene built{std::make_unique<FemModel>(std::move(parts)), {}, std::move(loaded.warnings)};
  add_notes(scene, built.warnings);
  add_note_on_means(scene, built.model->parts().mesh, built.warnings);
  built.initial = initial_state(scene.initial, scene.time.start, *built.model);
  return built;
}

}  // namespace orthodyn
