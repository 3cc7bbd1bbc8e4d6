#include "lib/scene/mesh_materials.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/scene/abaqus_conditions.h"

namespace orthodyn {

namespace {

std::string stiffness_yaml(const MeshMaterial& m) {
  std::string text = fmt::format("{{type: anisotropic, voigt_order: abaqus, density: {}", number_text(m.density));
  std::size_t k = 0;
  for (int column = 1; column <= 6; ++column)
    for (int row = 1; row <= column; ++row, ++k)
      if (m.stiffness[k] != 0 || row == column || column <= 3)
        text += fmt::format(", c{}{}: {}", row, column, number_text(m.stiffness[k]));
  return text + "}";
}

std::string region_yaml(const MeshMaterial& m) {
  if (m.axes == Mat3::Identity()) return "{}";
  return fmt::format("{{axes: {{first: {}, second: {}}}}}", Value<Vec3>::yaml(m.axes.col(0)),
                     Value<Vec3>::yaml(m.axes.col(1)));
}

void fill_axes_by_element(const Config& region, const std::string& file) {
  region.fill("axes", "{type: file}").fill_text("file", std::filesystem::absolute(file).string());
}

// Refuses materials with properties that orthodyn does not support, instead of ignoring these properties.
void check_can_be_taken(const MeshMaterial& m) {
  if (!m.problem.empty())
    throw ConfigError(
        m.where,
        fmt::format(
            "material '{}' of the mesh: {}; give `materials` in the scene, which replaces the materials of the file",
            m.name, m.problem));
  for (const auto& [where, name] : m.beyond)
    throw ConfigError(
        where, fmt::format("material '{}' of the mesh: {} is not supported, only linear elasticity is; to compute "
                           "without it, give `materials` in the scene (`orthodyn init --from` writes them)",
                           m.name, name));
}

void check_all_regions_have_one(const Config& config, const LoadedMesh& loaded) {
  if (loaded.materials.empty() && loaded.layups.empty())
    config.fail("key 'materials' is missing, and the mesh file has none; give materials and regions (" +
                join(loaded.mesh.region_names) + ")");
  for (const auto& name : loaded.mesh.region_names)
    if (!loaded.materials.contains(name) && !loaded.layups.contains(name))
      config.fail(
          fmt::format("key 'materials' is missing, and the mesh file has no material for its region '{}'; give "
                      "materials and regions ({})",
                      name, join(loaded.mesh.region_names)));
}

}  // namespace

std::string material_yaml(const MeshMaterial& m) {
  if (m.kind == MeshMaterial::Kind::isotropic)
    return fmt::format("{{type: isotropic, density: {}, young: {}, nu: {}}}", number_text(m.density),
                       number_text(m.young[0]), number_text(m.nu12));
  if (m.kind == MeshMaterial::Kind::anisotropic) return stiffness_yaml(m);
  const auto [ratio, value] = m.nu13 ? std::pair("nu13", *m.nu13) : std::pair("nu31", m.nu31);
  return fmt::format(
      "{{type: orthotropic, density: {}, young: {}, nu12: {}, nu23: {}, {}: {}, g12: {}, g23: {}, g13: {}}}",
      number_text(m.density), Value<Vec3>::yaml(m.young), number_text(m.nu12), number_text(m.nu23), ratio,
      number_text(value), number_text(m.g12), number_text(m.g23), number_text(m.g31));
}

std::string layup_yaml(const MeshLayup& layup) {
  std::vector<std::string> plies;
  for (const MeshPly& ply : layup.plies)
    plies.push_back(fmt::format("[{}, {} deg, {}]", yaml_name(ply.material.name), number_text(ply.degrees),
                                number_text(ply.thickness)));
  return "[" + join(plies) + "]";
}

LoadedMesh load_mesh(const Scene& scene) { return scene.loaded ? *scene.loaded : scene.mesh->load(); }

void fill_mesh_materials(const Config& config, Scene& scene) {
  if (!scene.mesh->may_bring_materials()) config.fail("key 'materials' is missing (name: section with type)");
  const auto mesh = std::make_shared<LoadedMesh>(scene.mesh->load());
  LoadedMesh& loaded = *mesh;
  scene.loaded = mesh;
  check_all_regions_have_one(config, loaded);
  const Config materials = config.fill("materials", "{}");
  for_each_material(std::as_const(loaded), [&](const std::string&, const MeshMaterial& material) {
    check_can_be_taken(material);
    if (materials.has(material.name)) return;
    if (!material.without_effect.empty())
      loaded.warnings.push_back(fmt::format("{}: material '{}' of the mesh: not used by orthodyn: {}", material.where,
                                            material.name, join(material.without_effect)));
    try {
      const Config filled = materials.fill(material.name, material_yaml(material));
      scene.materials.emplace_back(material.name, Registry<Material>::read(filled));
    } catch (const ConfigError& e) {
      throw ConfigError(material.where, std::string("material of the mesh: ") + e.what());
    }
  });
  if (!scene.regions.empty()) return;
  const Config regions = config.fill("regions", "{}");
  for (const auto& [name, material] : loaded.materials) {
    const Config region = regions.fill(name, region_yaml(material));
    region.fill_text("material", material.name);
    if (!material.axes_file.empty()) fill_axes_by_element(region, material.axes_file);
  }
  for (const auto& [name, layup] : loaded.layups) {
    const Config region = regions.fill(name, fmt::format("{{layup: {}}}", layup_yaml(layup)));
    if (!layup.axes_file.empty()) fill_axes_by_element(region, layup.axes_file);
  }
  scene.regions = Value<Named<Region>>::read(regions, {});
}

}  // namespace orthodyn
