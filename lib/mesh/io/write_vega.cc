// Vega: sets, materials and regions; .bou for the node set "fixed".
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "lib/mesh/io/mesh_writer.h"

namespace orthodyn {
namespace {

// Blanks and commas have another meaning there.
std::string vega_name(std::string name) {
  const auto has_meaning = [](char c) { return (c >= '\0' && c <= ' ') || c == ',' || c == '#' || c == '*'; };
  std::replace_if(name.begin(), name.end(), has_meaning, '_');
  return name;
}

std::string material_line(const MeshMaterial& m) {
  if (m.kind == MeshMaterial::Kind::isotropic) return fmt::format("ENU, {}, {}, {}\n", m.density, m.young[0], m.nu12);
  std::string line = fmt::format("ORTHOTROPIC, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}", m.density, m.young[0],
                                 m.young[1], m.young[2], m.nu12, m.nu23, m.nu31, m.g12, m.g23, m.g31);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) line += fmt::format(", {}", m.axes(i, j));
  }
  return line + "\n";
}

void add_list(std::string& text, const std::vector<std::size_t>& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) text += fmt::format("{},{}", numbers[k], k % 10 == 9 ? "\n" : "");
  if (numbers.size() % 10 != 0) text += "\n";
}

}  // namespace

WrittenMesh write_vega(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  WrittenMesh written;
  std::string text = fmt::format("*VERTICES\n{} 3 0 0\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", n + 1, mesh.nodes[n][0], mesh.nodes[n][1], mesh.nodes[n][2]);
  }
  text += fmt::format("\n*ELEMENTS\nTET\n{} 4 0\n", mesh.tets.size());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Tet& t = mesh.tets[e];
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {}\n", e + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  using NameAndLine = std::pair<std::string, std::string>;
  std::map<NameAndLine, std::string> materials;  // and the name in the file
  std::map<std::string, std::string> regions;
  TakenNames set_names, material_names;
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
    const std::string& region = mesh.region_names[r];
    const std::string name = unique_name(set_names, region, vega_name(region), written);
    std::vector<std::size_t> members;
    for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
      if (mesh.region_of[e] == static_cast<int>(r)) members.push_back(e + 1);
    }
    if (name != "allElements") {
      text += fmt::format("\n*SET {}\n", name);
      add_list(text, members);
    }
    if (const auto m = loaded.materials.find(region); m != loaded.materials.end()) {
      const NameAndLine material{m->second.name, material_line(m->second)};
      if (!materials.contains(material)) {
        materials[material] = unique_name(material_names, material.first, vega_name(material.first), written);
      }
      regions[name] = materials[material];
    }
  }
  for (const auto& [material, name] : materials) text += fmt::format("\n*MATERIAL {}\n{}", name, material.second);
  for (const auto& [name, material] : regions) text += fmt::format("\n*REGION\n{}, {}\n", name, material);
  written.files.push_back({".veg", std::move(text)});
  std::vector<std::string> lost;
  for (const auto& [name, nodes] : mesh.node_sets) {
    if (name != "fixed" || nodes.empty()) {
      lost.push_back(name);
      continue;
    }
    std::string list;
    add_list(list, [&, &members = nodes] {
      std::vector<std::size_t> numbers;
      for (const int n : members) numbers.push_back(static_cast<std::size_t>(n) + 1);
      return numbers;
    }());
    written.files.push_back({".bou", std::move(list)});
  }
  note_loss(written, "surfaces", names_of(mesh.surfaces));
  note_loss(written, "node sets other than \"fixed\"", lost);
  LoadedMesh without_materials;
  without_materials.cell_data = loaded.cell_data;
  note_lost_materials_and_data(written, without_materials);
  return written;
}

}  // namespace orthodyn
