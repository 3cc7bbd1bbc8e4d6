// Gmsh formats 2.2 and 4.1: regions, surfaces and node sets as physical volumes, surfaces and points.
#include <fmt/format.h>

#include <iterator>

#include "lib/mesh/io/mesh_writer.h"

namespace orthodyn {
namespace {

// One physical group with its elements, as lines of node tags.
struct Group {
  int dim, tag;
  std::string name;
  std::vector<std::vector<int>> elements;
};

template <class Nodes>
std::vector<int> tags_of(const Nodes& nodes) {
  std::vector<int> tags;
  for (const int n : nodes) tags.push_back(n + 1);
  return tags;
}

std::vector<Group> groups_of(const TetMesh& mesh) {
  std::vector<Group> groups;
  int tag = 0;
  for (const auto& [name, nodes] : mesh.node_sets) {
    groups.push_back({0, ++tag, name, {}});
    for (const int n : nodes) groups.back().elements.push_back({n + 1});
  }
  tag = 0;
  for (const auto& [name, triangles] : mesh.surfaces) {
    groups.push_back({2, ++tag, name, {}});
    for (const Triangle& t : triangles) groups.back().elements.push_back(tags_of(t));
  }
  tag = 0;
  for (const std::string& name : mesh.region_names) groups.push_back({3, ++tag, name, {}});
  return groups;
}

constexpr int type_of(int dim) { return dim == 0 ? 15 : dim == 2 ? 2 : 4; }

class Text {
 public:
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }
  void add_numbers(const std::vector<int>& numbers) {
    for (const int n : numbers) add(" {}", n);
    add("\n");
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add_head(Text& text, const char* version, const std::vector<Group>& groups) {
  text.add("$MeshFormat\n{} 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", version, groups.size());
  for (const Group& g : groups) text.add("{} {} \"{}\"\n", g.dim, g.tag, g.name);
  text.add("$EndPhysicalNames\n");
}

WrittenMesh finish(Text& text, const LoadedMesh& loaded) {
  WrittenMesh written;
  written.files.push_back({".msh", text.take()});
  note_lost_materials_and_data(written, loaded);
  return written;
}

}  // namespace

WrittenMesh write_gmsh22(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  const std::vector<Group> groups = groups_of(mesh);
  Text text;
  add_head(text, "2.2", groups);
  text.add("$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3& x = mesh.nodes[n];
    text.add("{} {} {} {}\n", n + 1, x[0], x[1], x[2]);
  }
  std::size_t count = mesh.tets.size();
  for (const Group& g : groups) count += g.elements.size();
  text.add("$EndNodes\n$Elements\n{}\n", count);
  std::size_t number = 0;
  for (const Group& g : groups) {
    for (const auto& nodes : g.elements) {
      text.add("{} {} 2 {} {}", ++number, type_of(g.dim), g.tag, g.tag);
      text.add_numbers(nodes);
    }
  }
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    text.add("{} 4 2 {} {}", ++number, mesh.region_of[e] + 1, mesh.region_of[e] + 1);
    text.add_numbers(tags_of(mesh.tets[e]));
  }
  text.add("$EndElements\n");
  return finish(text, loaded);
}

// One entity per group; consecutive tets of a region form one block, so that their order stays.
WrittenMesh write_gmsh41(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  const std::vector<Group> groups = groups_of(mesh);
  const Box box = bounding_box(mesh);
  Text text;
  add_head(text, "4.1", groups);
  text.add("$Entities\n{} 0 {} {}\n", mesh.node_sets.size(), mesh.surfaces.size(), mesh.region_names.size());
  for (const Group& g : groups) {
    if (g.dim == 0) {
      const Vec3 x = g.elements.empty() ? box.min : mesh.nodes[static_cast<std::size_t>(g.elements[0][0] - 1)];
      text.add("{} {} {} {} 1 {}\n", g.tag, x[0], x[1], x[2], g.tag);
    } else {
      text.add("{} {} {} {} {} {} {} 1 {} 0\n", g.tag, box.min[0], box.min[1], box.min[2], box.max[0], box.max[1],
               box.max[2], g.tag);
    }
  }
  const std::size_t nodes = mesh.nodes.size();
  text.add("$EndEntities\n$Nodes\n1 {} 1 {}\n3 1 0 {}\n", nodes, nodes, nodes);
  for (std::size_t n = 1; n <= nodes; ++n) text.add("{}\n", n);
  for (const Vec3& x : mesh.nodes) text.add("{} {} {}\n", x[0], x[1], x[2]);
  std::size_t blocks = 0, count = mesh.tets.size();
  Text elements;
  std::size_t number = 0;
  for (const Group& g : groups) {
    if (g.elements.empty()) continue;
    ++blocks;
    count += g.elements.size();
    elements.add("{} {} {} {}\n", g.dim, g.tag, type_of(g.dim), g.elements.size());
    for (const auto& e : g.elements) {
      elements.add("{}", ++number);
      elements.add_numbers(e);
    }
  }
  for (std::size_t e = 0; e < mesh.tets.size(); ++blocks) {
    std::size_t end = e;
    while (end < mesh.tets.size() && mesh.region_of[end] == mesh.region_of[e]) ++end;
    elements.add("3 {} 4 {}\n", mesh.region_of[e] + 1, end - e);
    for (; e < end; ++e) {
      elements.add("{}", ++number);
      elements.add_numbers(tags_of(mesh.tets[e]));
    }
  }
  text.add("$EndNodes\n$Elements\n{} {} 1 {}\n{}$EndElements\n", blocks, count, count, elements.take());
  return finish(text, loaded);
}

}  // namespace orthodyn
