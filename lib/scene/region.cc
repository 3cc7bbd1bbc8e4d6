#include "lib/scene/region.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/spelling.h"
#include "lib/material_axes/axes_source.h"
#include "lib/scene/scene.h"

namespace orthodyn {

const Spec<Region>& Region::spec() {
  static const auto s = Spec<Region>()
                            .key("material", &Region::material, "One of `materials`.", {.required = true})
                            .key("axes", &Region::axes, "Directions of the material axes, uniform or varying in space.",
                                 {.fallback = "{type: directions}"})
                            .key("stiffness_damping", &Region::stiffness_damping, "Overrides damping.stiffness here.",
                                 {.unit = "s", .range = kNonNegative})
                            .key("kinematics", &Region::kinematics, "Overrides elasticity.kinematics here.");
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
    if (std::find(names.begin(), names.end(), region.material) == names.end())
      region.origin.fail("material '" + region.material + "' is not among the materials: " + join(names));
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

}  // namespace

void complete_regions(const Config& config, Scene& scene) {
  fill_regions(config, scene);
  check_materials_exist(scene);
  check_kinematics(config, scene);
}

ElasticityOptions elasticity_of(const Scene& scene, const Region& region) {
  ElasticityOptions options = scene.elasticity;
  options.kinematics = region.kinematics.value_or(options.kinematics);
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
          fmt::format("region '{}' of the mesh has no material; add it, or 'all'", mesh.region_names[i]));
  }
  return out;
}

const Material& material_of(const Scene& scene, const Region& region) {
  for (const auto& [name, material] : scene.materials)
    if (name == region.material) return *material;
  region.origin.fail("unknown material");  // read_scene() has checked this
}

const std::pair<std::string, Region>& entry_of(const Scene& scene, const std::string& mesh_region) {
  const std::pair<std::string, Region>* found = nullptr;
  for (const auto& entry : scene.regions)
    if (entry.first == mesh_region || (entry.first == "all" && !found)) found = &entry;
  return *found;
}

}  // namespace orthodyn
