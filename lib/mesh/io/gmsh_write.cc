// Implements write_gmsh22() and write_gmsh41().
#include <utility>

#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/text_lines.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

// A physical group and its elements; the tets of regions are not stored here.
struct Group {
  int dim, tag;
  std::string name;
  std::vector<std::vector<int>> elements = {};  // nodes of each
};

std::vector<Group> groups_of(const TetMesh& mesh) {
  std::vector<Group> groups;
  int tag = 0;
  for (const auto& [name, nodes] : mesh.node_sets) {
    groups.push_back({0, ++tag, name});
    for (const int n : nodes) groups.back().elements.push_back({n});
  }
  tag = 0;
  for (const auto& [name, triangles] : mesh.surfaces) {
    groups.push_back({2, ++tag, name});
    const Cells faces = face_cells(mesh, triangles);
    for (std::size_t k = 0; k < faces.size(); ++k)
      groups.back().elements.emplace_back(faces[k].begin(), faces[k].end());
  }
  tag = 0;
  for (const std::string& name : mesh.region_names) groups.push_back({3, ++tag, name});
  return groups;
}

std::size_t elements_of(const TetMesh& mesh, const std::vector<Group>& groups) {
  std::size_t count = mesh.tets.size();
  for (const Group& group : groups) count += group.elements.size();
  return count;
}

int type_of(const TetMesh& mesh, int dim) {
  const bool quadratic = mesh.order() == 2;
  return dim == 0 ? 15 : dim == 2 ? (quadratic ? 9 : 2) : quadratic ? 11 : 4;
}

// Tets in Gmsh's order: edge 23 before edge 13.
std::vector<std::vector<int>> gmsh_tets(const TetMesh& mesh) {
  const Cells cells = tet_cells(mesh);
  std::vector<std::vector<int>> tets;
  tets.reserve(cells.size());
  for (std::size_t e = 0; e < cells.size(); ++e) {
    auto& nodes = tets.emplace_back(cells[e].begin(), cells[e].end());
    if (nodes.size() == 10) std::swap(nodes[8], nodes[9]);
  }
  return tets;
}

void add_head(TextLines& lines, const char* version, const std::vector<Group>& groups) {
  lines.line("$MeshFormat");
  lines.line(version, 0, 8);
  lines.text("$EndMeshFormat\n$PhysicalNames\n");
  lines.line(groups.size());
  for (const Group& group : groups) lines.line(group.dim, group.tag, "\"" + group.name + "\"");
  lines.line("$EndPhysicalNames");
}

WrittenMesh msh_file(TextLines& lines) { return {.files = {{".msh", lines.take()}}}; }

// One entity per group: tag, point or bounding box, physical group.
void add_entities(TextLines& lines, const TetMesh& mesh, const std::vector<Group>& groups) {
  const Box box = bounding_box(mesh);
  lines.line("$Entities");
  lines.line(mesh.node_sets.size(), 0, mesh.surfaces.size(), mesh.region_names.size());
  for (const Group& group : groups) {
    if (group.dim == 0) {
      const bool empty = group.elements.empty();
      const Vec3& x = empty ? box.min : mesh.nodes[static_cast<std::size_t>(group.elements[0][0])];
      lines.line(group.tag, x, 1, group.tag);
    } else {
      lines.line(group.tag, box.min, box.max, 1, group.tag, 0);
    }
  }
  lines.line("$EndEntities");
}

// All nodes in one block, which belongs to the first volume.
void add_nodes(TextLines& lines, const TetMesh& mesh) {
  const std::size_t nodes = mesh.nodes.size();
  lines.line("$Nodes");
  lines.line(1, nodes, 1, nodes);
  lines.line(3, 1, 0, nodes);
  for (std::size_t n = 1; n <= nodes; ++n) lines.line(n);
  for (const Vec3& x : mesh.nodes) lines.line(x);
  lines.line("$EndNodes");
}

// Consecutive tets of a region form a block, which keeps the order of the tets. Returns the number of blocks.
std::size_t add_blocks(TextLines& lines, const TetMesh& mesh, const std::vector<Group>& groups) {
  const auto tets = gmsh_tets(mesh);
  std::size_t blocks = 0, number = 0;
  for (const Group& group : groups) {
    if (group.elements.empty()) continue;
    ++blocks;
    lines.line(group.dim, group.tag, type_of(mesh, group.dim), group.elements.size());
    for (const auto& nodes : group.elements) lines.line(++number, FromOne{nodes});
  }
  for (std::size_t e = 0; e < mesh.tets.size(); ++blocks) {
    std::size_t end = e;
    while (end < mesh.tets.size() && mesh.region_of[end] == mesh.region_of[e]) ++end;
    lines.line(3, mesh.region_of[e] + 1, type_of(mesh, 3), end - e);
    for (; e < end; ++e) lines.line(++number, FromOne{tets[e]});
  }
  return blocks;
}

}  // namespace

WrittenMesh write_gmsh22(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  const std::vector<Group> groups = groups_of(mesh);
  TextLines lines;
  add_head(lines, "2.2", groups);
  lines.line("$Nodes");
  lines.line(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) lines.line(n + 1, mesh.nodes[n]);
  lines.text("$EndNodes\n$Elements\n");
  lines.line(elements_of(mesh, groups));
  const auto tets = gmsh_tets(mesh);
  std::size_t number = 0;
  for (const Group& group : groups)
    for (const auto& nodes : group.elements)
      lines.line(++number, type_of(mesh, group.dim), 2, group.tag, group.tag, FromOne{nodes});
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const int tag = mesh.region_of[e] + 1;
    lines.line(++number, type_of(mesh, 3), 2, tag, tag, FromOne{tets[e]});
  }
  lines.line("$EndElements");
  return msh_file(lines);
}

WrittenMesh write_gmsh41(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  const std::vector<Group> groups = groups_of(mesh);
  TextLines lines, elements;
  add_head(lines, "4.1", groups);
  add_entities(lines, mesh, groups);
  add_nodes(lines, mesh);
  const std::size_t blocks = add_blocks(elements, mesh, groups), count = elements_of(mesh, groups);
  lines.line("$Elements");
  lines.line(blocks, count, 1, count);
  lines.text(elements.take());
  lines.line("$EndElements");
  return msh_file(lines);
}

}  // namespace orthodyn
