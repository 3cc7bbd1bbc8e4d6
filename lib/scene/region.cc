#include "lib/scene/region.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/spelling.h"
#include "lib/material_axes/axes_source.h"
#include "lib/scene/scene.h"

namespace orthodyn {

template <>
struct EnumNames<Integration> {
  static constexpr std::array<std::pair<Integration, const char*>, 3> list{
      {{Integration::automatic, "auto"}, {Integration::reduced, "reduced"}, {Integration::full, "full"}}};
};

template <>
struct EnumNames<Formulation> {
  static constexpr std::array<std::pair<Formulation, const char*>, 3> list{
      {{Formulation::automatic, "auto"}, {Formulation::displacement, "displacement"}, {Formulation::mixed, "mixed"}}};
};

template <>
struct EnumNames<ElasticLaw> {
  static constexpr std::array<std::pair<ElasticLaw, const char*>, 2> list{
      {{ElasticLaw::corotational, "corotational"}, {ElasticLaw::neo_hookean, "neo_hookean"}}};
};

std::vector<std::string> Region::materials() const {
  if (layup.empty()) return {material};
  std::vector<std::string> all;
  for (const Ply& ply : layup) all.push_back(ply.material);
  return all;
}

const Spec<Region>& Region::spec() {
  static const auto s =
      Spec<Region>()
          .key("material", &Region::material, "One of `materials`; required without a layup.")
          .key("layup", &Region::layup,
               "Plies from bottom to top along axis 3 of `axes`, which goes through the thickness: "
               "each with its material, the angle from axis 1 of `axes` to axis 1 of the material "
               "about axis 3, and its thickness (m). For hexahedra and wedges; a cell may have "
               "several plies.")
          .key("axes", &Region::axes, "Directions of the material axes, uniform or varying in space.",
               {.fallback = "{type: directions}"})
          .key("stiffness_damping", &Region::stiffness_damping, "Overrides damping.stiffness here.",
               {.unit = "s", .range = kNonNegative})
          .key("kinematics", &Region::kinematics, "Overrides elasticity.kinematics here.")
          .key("law", &Region::law,
               "corotational: linear in the strain of the turned material. neo_hookean: for isotropic "
               "materials at large strain, such as rubber; its energy keeps elements from inverting.")
          .key("rigid", &Region::rigid,
               "The region moves as a rigid body, which has no stresses. true: its material gives the density. A "
               "section gives mass, centre and moments of inertia in place of the mesh and the density. Rigid "
               "regions that share nodes are one body.")
          .key("integration", &Region::integration,
               "Integration points of hexahedra of 20 nodes. reduced: 8 points, accurate for thin "
               "bodies. full: 14 points, for rows of cells that are one cell wide and high: with 8 "
               "points such rows have hourglass modes (shapes without stiffness). auto: full if the "
               "region has such rows.")
          .key("formulation", &Region::formulation,
               "mixed: with a separate pressure in each element, accurate for nearly incompressible "
               "materials, whose stresses are wrong with displacements alone; not for linear "
               "tetrahedra and elasticity.corotation: warped. auto: mixed for nearly incompressible "
               "materials.")
          .key("stiffness_factors", &Region::stiffness_factors,
               "Factors of the stiffness on a grid over the region, for bodies that are softer in "
               "places. They can be found by a fit.")
          .check([](const Region& region, const Config& config) {
            const std::pair<const char*, bool> elastic[] = {
                {"stiffness_damping", region.stiffness_damping.has_value()},
                {"kinematics", region.kinematics.has_value()},
                {"law", region.law != ElasticLaw::corotational},
                {"integration", region.integration != Integration::automatic},
                {"formulation", region.formulation != Formulation::automatic},
                {"stiffness_factors", region.stiffness_factors.has_value()}};
            for (const auto& [key, is_given] : elastic)
              if (region.rigid.is_rigid && is_given) config.at(key).fail("has no effect in a rigid region; remove it");
            if (region.rigid.inertia && !region.layup.empty())
              config.at("layup").fail("has no effect in a rigid region of given inertia; give a material");
            if (region.stiffness_factors && !region.layup.empty())
              config.at("stiffness_factors").fail("is not available for a region with a layup");
            if (region.law == ElasticLaw::neo_hookean && region.kinematics)
              config.at("kinematics").fail("has no effect with law: neo_hookean; remove it");
            if (region.material.empty() && region.layup.empty())
              config.fail("key 'material' is missing: give a material or a layup");
            if (!region.material.empty() && !region.layup.empty())
              config.at("material").fail("has no effect beside a layup; remove one of them");
          });
  return s;
}

namespace {

void fill_regions(const Config& config, Scene& scene) {
  if (!scene.regions.empty()) return;
  if (scene.materials.size() != 1)
    config.fail("key 'regions' is missing: with " + std::to_string(scene.materials.size()) +
                " materials, give the material of each region");
  const Config regions = config.fill("regions", "{all: {}}");
  regions.at("all").fill_text("material", scene.materials.front().first);
  scene.regions = Value<Named<Region>>::read(regions, {});
}

void check_materials_exist(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, material] : scene.materials) names.push_back(name);
  for (const auto& [name, region] : scene.regions)
    for (const std::string& material : region.materials())
      if (std::find(names.begin(), names.end(), material) == names.end())
        region.origin.fail("material '" + material + "' is not among the materials: " + join(names));
}

void check_kinematics(const Config& config, const Scene& scene) {
  const auto is_automatic = [&](const auto& named) {
    return elasticity_of(scene, named.second).kinematics == Kinematics::automatic;
  };
  const auto first = std::find_if(scene.regions.begin(), scene.regions.end(), is_automatic);
  if (first == scene.regions.end()) {
    if (scene.elasticity.linear_error)
      config.at("elasticity").at("linear_error").fail("has no effect without kinematics: auto; remove it");
  } else if (scene.elasticity.corotation == Corotation::warped) {
    first->second.origin.fail(
        "kinematics: auto supports the exact force only; with corotation: warped set linear or corotational");
  }
}

// Lumped masses change the inertia of a rigid body.
void choose_mass(const Config& config, Scene& scene) {
  const auto rigid = std::find_if(scene.regions.begin(), scene.regions.end(),
                                  [](const auto& entry) { return entry.second.rigid.is_rigid; });
  const bool has_rigid = rigid != scene.regions.end();
  if (has_rigid && scene.given_mass == MassKind::lumped)
    config.at("mass").fail(
        fmt::format("lumped changes the inertia of the rigid region '{}'; remove the key: scenes with rigid regions "
                    "have a consistent mass",
                    rigid->first));
  scene.mass = scene.given_mass.value_or(has_rigid ? MassKind::consistent : MassKind::lumped);
  if (!scene.given_mass) config.fill_text("mass", has_rigid ? "consistent" : "lumped");
}

}  // namespace

void complete_regions(const Config& config, Scene& scene) {
  fill_regions(config, scene);
  check_materials_exist(scene);
  check_kinematics(config, scene);
  choose_mass(config, scene);
}

ElasticityOptions elasticity_of(const Scene& scene, const Region& region) {
  ElasticityOptions options = scene.elasticity;
  options.kinematics = region.kinematics.value_or(options.kinematics);
  if (region.law == ElasticLaw::neo_hookean) options = {};  // the law has no variants
  return options;
}

std::vector<const Region*> assign_regions(const Scene& scene, const Mesh& mesh) {
  std::vector<const Region*> out(mesh.region_names.size(), nullptr);
  const Region* everywhere = nullptr;
  for (const auto& [name, region] : scene.regions) {
    const auto it = std::find(mesh.region_names.begin(), mesh.region_names.end(), name);
    if (it != mesh.region_names.end()) out[static_cast<std::size_t>(it - mesh.region_names.begin())] = &region;
    else if (name == "all") everywhere = &region;
    else
      region.origin.fail(
          fmt::format("the mesh has no region '{}'; it has {} (or use 'all')", name, join(mesh.region_names)));
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!out[i]) out[i] = everywhere;
    if (!out[i])
      scene.regions.front().second.origin.fail(
          fmt::format("region '{}' of the mesh has no entry; add one for it, or one for 'all'", mesh.region_names[i]));
  }
  return out;
}

const Material& material_named(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return *found->second;
}

const std::pair<std::string, Region>& entry_of(const Scene& scene, const std::string& mesh_region) {
  const std::pair<std::string, Region>* found = nullptr;
  for (const auto& entry : scene.regions)
    if (entry.first == mesh_region || (entry.first == "all" && !found)) found = &entry;
  return *found;
}

}  // namespace orthodyn
