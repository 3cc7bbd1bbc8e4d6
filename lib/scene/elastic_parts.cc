#include "lib/scene/elastic_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>

#include "lib/fem/element_groups.h"
#include "lib/fem/terms/observed_elastic_term.h"
#include "lib/material/stiffness_contrast.h"
#include "lib/mesh/cell_rows.h"
#include "lib/mesh/stack.h"
#include "lib/scene/added_laws.h"
#include "lib/scene/layup.h"

namespace orthodyn {

namespace {

std::vector<std::vector<int>> cells_of_regions(const Mesh& mesh) {
  std::vector<std::vector<int>> cells(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.region_of.size(); ++e)
    cells[static_cast<std::size_t>(mesh.region_of[e])].push_back(static_cast<int>(e));
  return cells;
}

using CellsByShape = std::map<CellShape, std::vector<int>>;

CellsByShape by_shape(const Mesh& mesh, const std::vector<int>& cells) {
  CellsByShape out;
  for (const int cell : cells) out[mesh.cells.shape(static_cast<std::size_t>(cell))].push_back(cell);
  return out;
}

std::string names_of(const CellsByShape& cells) {
  std::string names;
  for (const auto& [shape, own] : cells) names += (names.empty() ? "" : " and ") + std::string(topology(shape).plural);
  return names;
}

void check_shapes(const Region& region, const std::string& name, const CellsByShape& cells) {
  if (region.integration != Integration::automatic && !cells.contains(CellShape::hex20))
    region.origin.fail(
        fmt::format("integration: can be chosen for hexahedra of 20 nodes only, but the region has {}; remove it",
                    names_of(cells)));
  if (!region.layup.empty() && cells.size() > 1)
    region.origin.fail(
        fmt::format("layup: region '{}' has {}; plies need elements of one kind: put each kind into a region of its "
                    "own",
                    name, names_of(cells)));
}

// "tetrahedra", "wedges" or "hexahedra"; "hexahedra_20" if the region also has hexahedra with another number of nodes.
// Empty if the region has cells of one shape.
std::string kind_of(CellShape shape, const CellsByShape& cells) {
  if (cells.size() == 1) return "";
  const CellTopology& own = topology(shape);
  const std::string name = own.corners == 4 ? "tetrahedra" : own.corners == 6 ? "wedges" : "hexahedra";
  const auto same = std::count_if(cells.begin(), cells.end(),
                                  [&](const auto& entry) { return topology(entry.first).corners == own.corners; });
  return same == 1 ? name : fmt::format("{}_{}", name, own.nodes);
}

// The element type of a region's cells of one shape. `in_row`: cells_in_rows().
const ElementType& type_of_cells(const Region& region, CellShape shape, const std::vector<int>& cells,
                                 const std::vector<char>& in_row) {
  if (shape != CellShape::hex20) return element_type(shape);
  const bool has_rows =
      std::any_of(cells.begin(), cells.end(), [&](int cell) { return in_row[static_cast<std::size_t>(cell)] != 0; });
  const bool full =
      region.integration == Integration::full || (region.integration == Integration::automatic && has_rows);
  return full ? quadratic_hexahedron_14() : quadratic_hexahedron();
}

// Why a part of the region cannot have the mixed formulation; "" if it can.
std::string mixed_obstacle(const Scene& scene, const Region& region, const Material& material,
                           const ElementType& type) {
  if (!type.has_mixed_formulation()) return fmt::format("for {}; set mesh.order: 2", topology(type.shape()).plural);
  if (elasticity_of(scene, region).is_warped()) return "with elasticity.corotation: warped";
  if (region.law == ElasticLaw::neo_hookean) return "with law: neo_hookean";
  if (swells(scene, material)) return "for a material that swells by moisture or temperature";
  if (relaxes_in_volume(material.viscoelasticity(), voigt(material.stiffness())))
    return "for a material whose bulk modulus relaxes; give `deviatoric` shares";
  return "";
}

// Sets the formulation of a part, whose other members are known.
void set_formulation(const Scene& scene, const Region& region, const Material& material, const ElementType& type,
                     ElasticRegion& part) {
  if (is_viscoelastic(material))
    part.relaxed = AnisotropicStiffness{relaxed_stiffness(material.viscoelasticity(), voigt(part.stiffness))};
  part.mixed_obstacle = mixed_obstacle(scene, region, material, type);
  if (region.formulation == Formulation::mixed && !part.mixed_obstacle.empty())
    region.origin.fail("formulation: mixed is not available " + part.mixed_obstacle);
  part.mixed = part.mixed_obstacle.empty() &&
               (region.formulation == Formulation::mixed ||
                (region.formulation == Formulation::automatic && is_nearly_incompressible(part.softest())));
}

// Axes turned by `angle` (rad) about their axis 3.
AxesField turned(const AxesField& axes, double angle) {
  if (angle == 0) return axes;
  const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  return [axes, turn](const Vec3& point, int cell) -> Mat3 { return axes(point, cell) * turn; };
}

void note_thickness(const std::string& region, const Region& entry, const Stack& stack, Warnings& notes) {
  constexpr double kDiffers = 0.01;
  const double total = total_thickness(entry.layup);
  if (stack.lowest >= (1 - kDiffers) * total && stack.highest <= (1 + kDiffers) * total) return;
  notes.push_back(fmt::format(
      "{}: the plies of region '{}' have a total thickness of {:.4g} m, but its cells along axis 3 are {}; the plies "
      "are scaled to the cells. Check the unit of the thicknesses, and that axis 3 goes through the thickness",
      entry.origin.where, region, total,
      stack.highest > (1 + kDiffers) * stack.lowest
          ? fmt::format("{:.4g} to {:.4g} m thick", stack.lowest, stack.highest)
          : fmt::format("{:.4g} m thick", stack.highest)));
}

// The bounding box of the cells of all regions of the mesh that an entry of the scene describes.
Box box_of(const Region& entry, const std::vector<const Region*>& regions, const Mesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    if (regions[static_cast<std::size_t>(mesh.region_of[e])] != &entry) continue;
    for (const int node : mesh.cells[e]) {
      box.min = box.min.cwiseMin(mesh.node(node));
      box.max = box.max.cwiseMax(mesh.node(node));
    }
  }
  return box;
}

Stiffness scaled(const Stiffness& stiffness, double factor) {
  if (factor == 1) return stiffness;
  return std::visit(
      [&](const auto& c) -> Stiffness {
        if constexpr (std::decay_t<decltype(c)>::kIsotropic)
          return IsotropicStiffness{factor * c.lambda, factor * c.mu};
        else return factor * c;
      },
      stiffness);
}

// Makes the parts of one region.
class PartMaker {
 public:
  PartMaker(const Scene& scene, const std::vector<const Region*>& regions, Mesh& mesh, ElasticParts& out)
      : scene_(scene), regions_(regions), mesh_(mesh), out_(out) {}

  // `kind`: kind_of() these cells.
  void add(std::size_t region, const Region& entry, const AxesField& axes, const ElementType& type,
           const std::string& kind, std::vector<int> cells, Warnings& notes) {
    if (!entry.layup.empty()) return add_plies(region, entry, axes, type, notes);
    const Material& material = material_named(scene_, entry.material);
    set_density(cells, material.density());
    const ElasticPart part{mesh_.region_names[region] + (kind.empty() ? "" : "." + kind),
                           region,
                           &entry,
                           &material,
                           axes,
                           &type,
                           std::move(cells),
                           1,
                           material.density()};
    if (entry.stiffness_factors) add_grid(part, *entry.stiffness_factors, notes);
    else out_.parts.push_back(part);
  }

 private:
  // Divides a part into the cells of the grid of factors.
  void add_grid(const ElasticPart& whole, const StiffnessFactors& factors, Warnings& notes) {
    const Box box = box_of(*whole.entry, regions_, mesh_);
    const std::vector<double> values = factors.all();
    std::map<int, std::vector<int>> cells;
    for (const int cell : whole.cells) cells[factors.cell_at(centroid(mesh_, cell), box)].push_back(cell);
    if (const std::size_t empty = values.size() - cells.size(); empty > 0)
      notes.push_back(
          fmt::format("{}: {} of {} cells of the grid have no element of '{}'; their factors have no effect. Use a "
                      "coarser grid or a "
                      "finer mesh",
                      factors.origin.where, empty, values.size(), whole.name));
    for (auto& [number, own] : cells) {
      ElasticPart part = whole;
      part.name += fmt::format(".cell_{}", number + 1);
      part.cells = std::move(own);
      part.stiffness_cell = number;
      part.stiffness_factor = values[static_cast<std::size_t>(number)];
      out_.parts.push_back(std::move(part));
    }
  }

  void add_plies(std::size_t region, const Region& entry, const AxesField& axes, const ElementType& type,
                 Warnings& notes) {
    const std::string& name = mesh_.region_names[region];
    const Stack stack = make_stack(mesh_, static_cast<int>(region),
                                   [&](int cell) { return Vec3(axes(centroid(mesh_, cell), cell).col(2)); });
    note_thickness(name, entry, stack, notes);
    const std::vector<PlyPart> plies = divide(entry.layup, stack);
    std::vector<double> density(stack.levels.size(), 0);
    for (const PlyPart& ply : plies) density[ply.level] += ply.share() * material_of(entry, ply).density();
    for (std::size_t l = 0; l < stack.levels.size(); ++l) set_density(stack.levels[l].cells, density[l]);
    for (const PlyPart& ply : plies) {
      out_.ply_types.push_back(type.ply(ply.begin, ply.end));
      out_.parts.push_back({name + "." + ply.name, region, &entry, &material_of(entry, ply),
                            turned(axes, entry.layup[ply.ply].angle), out_.ply_types.back().get(),
                            stack.levels[ply.level].cells, ply.share(), density[ply.level],
                            fmt::format("{}.ply_{}", name, ply.ply + 1)});
    }
  }

  const Material& material_of(const Region& entry, const PlyPart& ply) const {
    return material_named(scene_, entry.layup[ply.ply].material);
  }
  void set_density(const std::vector<int>& cells, double density) {
    for (const int cell : cells) out_.density[static_cast<std::size_t>(cell)] = density;
  }

  const Scene& scene_;
  const std::vector<const Region*>& regions_;
  Mesh& mesh_;
  ElasticParts& out_;
};

// A rank's cells of one part: local indices and, with several ranks, their indices in the whole mesh.
struct CellsOfRank {
  std::vector<int> here, numbers;
};

CellsOfRank cells_of_rank(const ElementMesh& own, const Subdomain* subdomain, const std::vector<int>& cells_of_part) {
  CellsOfRank cells;
  if (!subdomain) {
    cells.here = by_place(own, cells_of_part);
    return cells;
  }
  for (std::size_t e = 0; e < own.cells.size(); ++e)
    if (std::binary_search(cells_of_part.begin(), cells_of_part.end(), subdomain->cells()[e]))
      cells.here.push_back(static_cast<int>(e));
  if (!cells.here.empty()) cells.here = by_place(own, std::move(cells.here));
  for (const int cell : cells.here) cells.numbers.push_back(subdomain->cells()[static_cast<std::size_t>(cell)]);
  return cells;
}

}  // namespace

double stiffness_damping(const Scene& scene, const Region& region) {
  return region.stiffness_damping.value_or(scene.damping ? scene.damping->stiffness : 0);
}

Box grid_box(const Scene& scene, const std::string& name, const Mesh& mesh) {
  const std::vector<const Region*> regions = assign_regions(scene, mesh);
  for (const auto& [own, entry] : scene.regions)
    if (own == name) return box_of(entry, regions, mesh);
  throw ConfigError("regions", "there is no region " + name);
}

ElasticParts elastic_parts(const Scene& scene, const std::vector<const Region*>& regions, Mesh& mesh, Warnings& notes) {
  ElasticParts out;
  out.density.resize(mesh.cells.size());
  const std::vector<char> in_row = cells_in_rows(mesh);
  auto cells = cells_of_regions(mesh);
  PartMaker maker(scene, regions, mesh, out);
  std::map<const Region*, AxesField> fields;  // one entry of the scene may describe several regions of the mesh
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = *regions[r];
    if (cells[r].empty()) continue;
    AxesField& field = fields[&region];
    if (!field) field = region.axes->field(mesh, notes);
    CellsByShape shapes = by_shape(mesh, cells[r]);
    check_shapes(region, mesh.region_names[r], shapes);
    for (auto& [shape, own] : shapes) {
      const ElementType& type = type_of_cells(region, shape, own, in_row);
      maker.add(r, region, field, type, kind_of(shape, shapes), std::move(own), notes);
    }
  }
  for (std::size_t cell = 0; cell < out.density.size(); ++cell)
    if (regions[static_cast<std::size_t>(mesh.region_of[cell])]->rigid.inertia) out.density[cell] = 0;
  return out;
}

std::vector<std::unique_ptr<AddedTerm>> add_elasticity(const Scene& scene, ElasticParts elastic, const ElementMesh& own,
                                                       FemModel::Parts& parts) {
  std::vector<std::unique_ptr<AddedTerm>> added_terms;
  const ElementMesh elements(parts.mesh);
  for (ElasticPart& part : elastic.parts) {
    const Region& entry = *part.entry;
    if (entry.rigid.is_rigid) continue;
    const auto all = static_cast<int>(part.cells.size());
    CellsOfRank cells = cells_of_rank(own, parts.subdomain.get(), part.cells);
    const ElementAxes axes = cells.here.empty() ? ElementAxes(Mat3::Identity())
                                                : element_axes(*entry.axes, part.axes, *part.type, elements,
                                                               parts.subdomain ? cells.numbers : cells.here);
    const Stiffness stiffness = scaled(part.material->stiffness(), part.stiffness_factor);
    auto laws = added_laws(scene, part, voigt(stiffness), elements, parts.subdomain ? cells.numbers : cells.here);
    ElasticRegion region{part.name,
                         std::move(cells.here),
                         stiffness,
                         axes,
                         stiffness_damping(scene, entry),
                         elasticity_of(scene, entry),
                         part.material->strength(),
                         std::move(cells.numbers),
                         all,
                         parts.mesh.region_names[part.region],
                         part.ply,
                         parts.subdomain ? part.cells : std::vector<int>(),
                         part.share,
                         part.stiffness_cell,
                         part.stiffness_factor};
    set_formulation(scene, entry, *part.material, *part.type, region);
    auto term = part.type->elastic_term(own, std::move(region), *parts.pattern);
    const auto term_of = [&](std::unique_ptr<const AddedLaw> law) {
      return part.type->added_term(own, *term, std::move(law), *parts.pattern);
    };
    std::vector<const AddedTerm*> added;
    for (auto& law : laws) {
      added_terms.push_back(term_of(std::move(law)));
      added.push_back(added_terms.back().get());
    }
    auto replacing = replacing_law(scene, part);
    if (!added.empty() || replacing) {
      auto replacing_term = replacing ? term_of(std::move(replacing)) : nullptr;
      term = std::make_unique<ObservedElasticTerm>(std::move(term), std::move(added), std::move(replacing_term));
    }
    parts.elastic.push_back(std::move(term));
    parts.densities.push_back(part.density);
  }
  parts.ply_types = std::move(elastic.ply_types);
  return added_terms;
}

}  // namespace orthodyn
