#include "lib/scene/mesh_materials.h"

#include <fmt/format.h>

namespace orthodyn {

namespace {

std::string material_yaml(const MeshMaterial& m) {
  if (m.kind == MeshMaterial::Kind::isotropic)
    return fmt::format("{{type: isotropic, density: {}, young: {}, nu: {}}}", number_text(m.density),
                       number_text(m.young[0]), number_text(m.nu12));
  return fmt::format(
      "{{type: orthotropic, density: {}, young: {}, nu12: {}, nu23: {}, nu31: {}, g12: {}, g23: {}, g13: {}}}",
      number_text(m.density), Value<Vec3>::yaml(m.young), number_text(m.nu12), number_text(m.nu23),
      number_text(m.nu31), number_text(m.g12), number_text(m.g23), number_text(m.g31));
}

std::string region_yaml(const MeshMaterial& m) {
  if (m.axes == Mat3::Identity()) return "{}";
  return fmt::format("{{axes: {{first: {}, second: {}}}}}", Value<Vec3>::yaml(m.axes.col(0)),
                     Value<Vec3>::yaml(m.axes.col(1)));
}

void check_all_regions_have_one(const Config& config, const LoadedMesh& loaded) {
  if (loaded.materials.empty())
    config.fail("key 'materials' is missing, and the mesh file brings none; give materials and regions (" +
                join(loaded.mesh.region_names) + ")");
  for (const auto& name : loaded.mesh.region_names)
    if (!loaded.materials.contains(name))
      config.fail(fmt::format("key 'materials' is missing, and the mesh file says nothing of the material of its "
                              "region '{}'; give materials and regions ({})",
                              name, join(loaded.mesh.region_names)));
}

}  // namespace

LoadedMesh load_mesh(const Scene& scene) { return scene.loaded ? *scene.loaded : scene.mesh->load(); }

void fill_mesh_materials(const Config& config, Scene& scene) {
  if (!scene.mesh->may_bring_materials())
    config.fail("key 'materials' is missing (name: section with type)");
  scene.loaded = std::make_shared<const LoadedMesh>(scene.mesh->load());
  const LoadedMesh& loaded = *scene.loaded;
  check_all_regions_have_one(config, loaded);
  const Config materials = config.fill("materials", "{}");
  for (const auto& [region, material] : loaded.materials) {
    if (materials.has(material.name)) continue;
    try {
      const Config filled = materials.fill(material.name, material_yaml(material));
      scene.materials.emplace_back(material.name, Registry<Material>::read(filled));
    } catch (const ConfigError& e) {
      throw ConfigError(material.where, std::string("material of the mesh: ") + e.what());
    }
  }
  if (!scene.regions.empty()) return;
  const Config regions = config.fill("regions", "{}");
  for (const auto& [name, material] : loaded.materials)
    regions.fill(name, region_yaml(material)).fill_text("material", material.name);
  scene.regions = Value<Named<Region>>::read(regions, {});
}

}  // namespace orthodyn
