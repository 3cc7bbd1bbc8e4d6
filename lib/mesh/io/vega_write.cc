// Implements write_vega().
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/io/text_lines.h"
#include "lib/mesh/io/vega.h"

namespace orthodyn {
namespace {

// Replaces the characters with a meaning in the format.
std::string vega_name(std::string name) {
  const auto has_meaning = [](char c) { return (c >= '\0' && c <= ' ') || c == ',' || c == '#' || c == '*'; };
  std::replace_if(name.begin(), name.end(), has_meaning, '_');
  return name;
}

std::string material_line(const MeshMaterial& m) {
  TextLines lines(", ");
  if (m.kind == MeshMaterial::Kind::isotropic) {
    lines.line("ENU", m.density, m.young[0], m.nu12);
    return lines.take();
  }
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> axes = m.axes;
  lines.line("ORTHOTROPIC", m.density, m.young, m.nu12, m.nu23, m.nu31, m.g12, m.g23, m.g31,
             std::span<const double>(axes.data(), 9));
  return lines.take();
}

bool can_hold(const MeshMaterial& m, Warnings& losses) {
  const bool holds = m.problem.empty() && m.kind != MeshMaterial::Kind::anisotropic;
  if (!m.problem.empty()) losses.push_back(fmt::format("material \"{}\" is lost: {}", m.name, m.problem));
  else if (!holds)
    losses.push_back(fmt::format("the format cannot hold a stiffness matrix: material \"{}\" is lost", m.name));
  for (const auto& [where, name] : m.beyond)
    losses.push_back(fmt::format("the format cannot hold {} of material \"{}\": lost", name, m.name));
  if (holds && !m.axes_file.empty())
    losses.push_back(fmt::format("the format cannot hold axes by element: those of material \"{}\" are lost", m.name));
  return holds;
}

// Numbers from 1, ten per line, each followed by a comma.
std::string number_list(const std::vector<int>& indices) {
  std::string text;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    text += std::to_string(indices[k] + 1) + ",";
    if (k % 10 == 9 || k + 1 == indices.size()) text += "\n";
  }
  return text;
}

void add_vega_mesh(TextLines& lines, const Mesh& mesh) {
  lines.line("*VERTICES");
  lines.line(mesh.nodes.size(), 3, 0, 0);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) lines.line(n + 1, mesh.nodes[n]);
  lines.text("\n*ELEMENTS\nTET\n");
  lines.line(mesh.cells.size(), 4, 0);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) lines.line(e + 1, FromOne{mesh.cells.corners(e)});
}

std::vector<int> elements_in(const Mesh& mesh, int region) {
  std::vector<int> elements;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    if (mesh.region_of[e] == region) elements.push_back(static_cast<int>(e));
  return elements;
}

// The sets of all regions, then materials, then the material of each set.
void add_regions(TextLines& lines, const LoadedMesh& loaded, Warnings& losses) {
  using NameAndLine = std::pair<std::string, std::string>;
  std::map<NameAndLine, std::string> materials;  // -> name in the file
  std::map<std::string, std::string> material_of;
  TakenNames set_names, material_names;
  for (std::size_t r = 0; r < loaded.mesh.region_names.size(); ++r) {
    const std::string& region = loaded.mesh.region_names[r];
    const std::string name = unique_name(set_names, region, vega_name(region), losses);
    if (name != "allElements") {
      lines.text("\n*SET " + name + "\n");
      lines.text(number_list(elements_in(loaded.mesh, static_cast<int>(r))));
    }
    const auto m = loaded.materials.find(region);
    if (m == loaded.materials.end() || !can_hold(m->second, losses)) continue;
    const NameAndLine material{m->second.name, material_line(m->second)};
    if (!materials.contains(material))
      materials[material] = unique_name(material_names, material.first, vega_name(material.first), losses);
    material_of[name] = materials[material];
  }
  for (const auto& [material, name] : materials) lines.text("\n*MATERIAL " + name + "\n" + material.second);
  for (const auto& [region, material] : material_of) lines.text("\n*REGION\n" + region + ", " + material + "\n");
}

}  // namespace

WrittenMesh write_vega(const LoadedMesh& loaded) {
  if (loaded.mesh.order() == 2 || !loaded.mesh.has_tets_only())
    throw ConfigError("Vega files hold linear tetrahedra only; write .vtu, .msh or .inp");
  WrittenMesh written;
  TextLines lines;
  add_vega_mesh(lines, loaded.mesh);
  add_regions(lines, loaded, written.losses);
  written.files.push_back({".veg", lines.take()});
  std::vector<std::string> lost;
  for (const auto& [name, nodes] : loaded.mesh.node_sets) {
    if (name == "fixed" && !nodes.empty()) {
      written.files.push_back({".bou", number_list(nodes)});
    } else {
      lost.push_back(name);
    }
  }
  note_loss(written.losses, "node sets other than \"fixed\"", lost);
  return written;
}

}  // namespace orthodyn
