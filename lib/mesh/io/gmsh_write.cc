// Implements write_gmsh22() and write_gmsh41().
#include <utility>

#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/text_lines.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

struct GmshElement {
  int type;
  std::vector<int> nodes;
};

// Gmsh's element type of a shape, and its node order: for each of Gmsh's nodes, the place in the cell.
struct GmshOrder {
  int type;
  std::vector<std::size_t> places = {};  // empty: the same order
};

const GmshOrder& gmsh_order_of(CellShape shape) {
  static const GmshOrder tet4{4}, tri3{2}, tri6{9}, quad4{3}, quad8{16}, quad9{10}, wedge6{6}, hex8{5},
      tet10{11, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}}, wedge15{18, {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10}},
      wedge18{13, {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16}},
      hex20{17, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14}},
      hex27{12, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26}};
  switch (shape) {
    case CellShape::tet4: return tet4;
    case CellShape::tet10: return tet10;
    case CellShape::wedge6: return wedge6;
    case CellShape::wedge15: return wedge15;
    case CellShape::wedge18: return wedge18;
    case CellShape::hex8: return hex8;
    case CellShape::hex20: return hex20;
    case CellShape::hex27: return hex27;
    case CellShape::tri3: return tri3;
    case CellShape::tri6: return tri6;
    case CellShape::quad4: return quad4;
    case CellShape::quad8: return quad8;
    case CellShape::quad9: return quad9;
  }
  return tet4;
}

GmshElement gmsh_element(const Cells& cells, std::size_t cell) {
  const GmshOrder& order = gmsh_order_of(cells.shape(cell));
  GmshElement out{order.type, {cells[cell].begin(), cells[cell].end()}};
  for (std::size_t k = 0; k < order.places.size(); ++k) out.nodes[k] = cells[cell][order.places[k]];
  return out;
}

// A physical group and its elements; the cells of regions are not stored here.
struct Group {
  int dim, tag;
  std::string name;
  std::vector<GmshElement> elements = {};
};

std::vector<Group> groups_of(const Mesh& mesh) {
  std::vector<Group> groups;
  int tag = 0;
  for (const auto& [name, nodes] : mesh.node_sets) {
    groups.push_back({0, ++tag, name});
    for (const int n : nodes) groups.back().elements.push_back({15, {n}});
  }
  tag = 0;
  for (const auto& [name, listed] : mesh.surfaces) {
    groups.push_back({2, ++tag, name});
    const Cells faces = face_cells(mesh, listed);
    for (std::size_t k = 0; k < faces.size(); ++k) groups.back().elements.push_back(gmsh_element(faces, k));
  }
  tag = 0;
  for (const std::string& name : mesh.region_names) groups.push_back({3, ++tag, name});
  return groups;
}

std::size_t elements_of(const Mesh& mesh, const std::vector<Group>& groups) {
  std::size_t count = mesh.cells.size();
  for (const Group& group : groups) count += group.elements.size();
  return count;
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
void add_entities(TextLines& lines, const Mesh& mesh, const std::vector<Group>& groups) {
  const Box box = bounding_box(mesh);
  lines.line("$Entities");
  lines.line(mesh.node_sets.size(), 0, mesh.surfaces.size(), mesh.region_names.size());
  for (const Group& group : groups) {
    if (group.dim == 0) {
      const bool empty = group.elements.empty();
      const Vec3& x = empty ? box.min : mesh.node(group.elements[0].nodes[0]);
      lines.line(group.tag, x, 1, group.tag);
    } else {
      lines.line(group.tag, box.min, box.max, 1, group.tag, 0);
    }
  }
  lines.line("$EndEntities");
}

// All nodes in one block, which belongs to the first volume.
void add_nodes(TextLines& lines, const Mesh& mesh) {
  const std::size_t nodes = mesh.nodes.size();
  lines.line("$Nodes");
  lines.line(1, nodes, 1, nodes);
  lines.line(3, 1, 0, nodes);
  for (std::size_t n = 1; n <= nodes; ++n) lines.line(n);
  for (const Vec3& x : mesh.nodes) lines.line(x);
  lines.line("$EndNodes");
}

// Writes the elements in blocks. A block holds consecutive elements of one type, and of one region if they are cells;
// the order of the elements does not change. Returns the number of blocks.
std::size_t add_blocks(TextLines& lines, const Mesh& mesh, const std::vector<Group>& groups) {
  std::size_t blocks = 0, number = 0;
  for (const Group& group : groups)
    for (std::size_t k = 0; k < group.elements.size(); ++blocks) {
      std::size_t end = k;
      while (end < group.elements.size() && group.elements[end].type == group.elements[k].type) ++end;
      lines.line(group.dim, group.tag, group.elements[k].type, end - k);
      for (; k < end; ++k) lines.line(++number, FromOne{group.elements[k].nodes});
    }
  const auto& shapes = mesh.cells.shapes();
  for (std::size_t e = 0; e < mesh.cells.size(); ++blocks) {
    std::size_t end = e;
    while (end < mesh.cells.size() && mesh.region_of[end] == mesh.region_of[e] && shapes[end] == shapes[e]) ++end;
    lines.line(3, mesh.region_of[e] + 1, gmsh_order_of(shapes[e]).type, end - e);
    for (; e < end; ++e) lines.line(++number, FromOne{gmsh_element(mesh.cells, e).nodes});
  }
  return blocks;
}

}  // namespace

WrittenMesh write_gmsh22(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  const std::vector<Group> groups = groups_of(mesh);
  TextLines lines;
  add_head(lines, "2.2", groups);
  lines.line("$Nodes");
  lines.line(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) lines.line(n + 1, mesh.nodes[n]);
  lines.text("$EndNodes\n$Elements\n");
  lines.line(elements_of(mesh, groups));
  std::size_t number = 0;
  for (const Group& group : groups)
    for (const auto& [type, nodes] : group.elements)
      lines.line(++number, type, 2, group.tag, group.tag, FromOne{nodes});
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const int tag = mesh.region_of[e] + 1;
    const auto [type, nodes] = gmsh_element(mesh.cells, e);
    lines.line(++number, type, 2, tag, tag, FromOne{nodes});
  }
  lines.line("$EndElements");
  return msh_file(lines);
}

WrittenMesh write_gmsh41(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
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
