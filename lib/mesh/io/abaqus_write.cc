// Implements write_abaqus(): nodes, blocks of elements, then sets and surfaces.
#include <algorithm>
#include <cctype>
#include <span>
#include <utility>

#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/abaqus_file.h"
#include "lib/mesh/io/text_lines.h"
#include "lib/mesh/mesh_faces.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

// Replaces the characters that even a quoted name cannot contain, and blanks at its ends.
std::string abaqus_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return (c >= '\0' && c < ' ') || c == '"'; }, '_');
  if (!name.empty() && name.front() == ' ') name.front() = '_';
  if (!name.empty() && name.back() == ' ') name.back() = '_';
  return name;
}

// Quotes only if necessary: some readers treat them as part of the name.
std::string quoted_if_needed(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; };
  const bool is_plain = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) &&
                        std::all_of(name.begin(), name.end(), plain);
  return is_plain ? name : "\"" + name + "\"";
}

// "*ELSET, ELSET=name" and the numbers, sixteen per line.
void add_set(TextLines& lines, const std::string& keyword, const std::string& name, std::span<const int> numbers) {
  lines.line("*" + keyword, keyword + "=" + quoted_if_needed(name));
  for (; !numbers.empty(); numbers = numbers.subspan(std::min<std::size_t>(16, numbers.size())))
    lines.line(numbers.first(std::min<std::size_t>(16, numbers.size())));
}

// The element type of a shape, and the nodes of an element in Abaqus' order: for each place there, the place in the
// cell.
struct AbaqusType {
  const char* name;
  CellKind kind;
  std::vector<std::size_t> order = {};  // empty: the same order
};

const AbaqusType& type_of(CellShape shape) {
  // After the mid-edge nodes C3D27 lists the node at the centre, then the nodes in the middle of the faces S1 to S6.
  static const AbaqusType tet4{"C3D4", CellKind::tet}, tet10{"C3D10", CellKind::tet}, wedge6{"C3D6", CellKind::wedge},
      hex8{"C3D8", CellKind::hexahedron}, wedge15{"C3D15", CellKind::wedge}, wedge18{"C3D15V", CellKind::wedge},
      hex20{"C3D20R", CellKind::hexahedron},
      hex27{"C3D27", CellKind::hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                            14, 15, 16, 17, 18, 19, 26, 24, 25, 22, 21, 23, 20}};
  switch (shape) {
    case CellShape::tet10: return tet10;
    case CellShape::wedge6: return wedge6;
    case CellShape::hex8: return hex8;
    case CellShape::wedge15: return wedge15;
    case CellShape::wedge18: return wedge18;
    case CellShape::hex20: return hex20;
    case CellShape::hex27: return hex27;
    default: return tet4;
  }
}

// The number (from 1) of an element and the side S1, S2, ... that is this face. For an inner face, the element on which
// it has the same orientation is preferred.
std::pair<int, int> element_and_side(const Mesh& mesh, const std::vector<MeshFace>& faces, const FaceCorners& face) {
  FaceCorners key = face;
  const bool flipped = key.sort();
  const auto [begin, end] = find_faces(faces, face);
  if (begin == end) return {0, 0};  // not a face: the mesh is invalid
  std::size_t found = begin;
  for (std::size_t f = begin; f < end; ++f)
    if (faces[f].flipped != flipped) {  // sides are listed clockwise from outside (split_cells.h)
      found = f;
      break;
    }
  const auto cell = static_cast<std::size_t>(faces[found].cell);
  const auto& sides = faces_of(type_of(mesh.cells.shape(cell)).kind);
  for (std::size_t side = 0; side < sides.size(); ++side) {
    std::vector<int> corners;
    for (const std::size_t k : sides[side]) corners.push_back(mesh.cells[cell][k]);
    FaceCorners own(corners);
    own.sort();
    if (own == key) return {static_cast<int>(cell) + 1, static_cast<int>(side) + 1};
  }
  return {0, 0};
}

// At most sixteen entries on a line; a comma at its end announces the next line.
void add_element(TextLines& lines, std::size_t number, std::span<const int> nodes) {
  constexpr std::size_t kFirst = 15, kNext = 16;
  const auto head = nodes.first(std::min(kFirst, nodes.size()));
  std::span<const int> rest = nodes.subspan(head.size());
  lines.add(number);
  lines.add(FromOne{head});
  while (!rest.empty()) {
    lines.add("");
    lines.end_line();
    const auto part = rest.first(std::min(kNext, rest.size()));
    lines.add(FromOne{part});
    rest = rest.subspan(part.size());
  }
  lines.end_line();
}

// Consecutive elements of a shape form a block.
void add_abaqus_mesh(TextLines& lines, const Mesh& mesh) {
  lines.text("*HEADING\nwritten by orthodyn\n*NODE\n");
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) lines.line(n + 1, mesh.nodes[n]);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const AbaqusType& type = type_of(mesh.cells.shape(e));
    if (e == 0 || mesh.cells.shape(e) != mesh.cells.shape(e - 1))
      lines.text(std::string("*ELEMENT, TYPE=") + type.name + "\n");
    std::vector<int> nodes(mesh.cells[e].begin(), mesh.cells[e].end());
    for (std::size_t k = 0; k < type.order.size(); ++k) nodes[k] = mesh.cells[e][type.order[k]];
    add_element(lines, e + 1, nodes);
  }
}

// Unique names of sets in the file.
class AbaqusNames {
 public:
  explicit AbaqusNames(Warnings& losses) : losses_(losses) {}
  std::string give(const std::string& name) { return unique_name(taken_, name, abaqus_name(name), losses_); }

 private:
  Warnings& losses_;
  TakenNames taken_{.capitals_differ = false};
};

void add_regions(TextLines& lines, const Mesh& mesh, Warnings& losses) {
  std::vector<std::vector<int>> members(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    members[static_cast<std::size_t>(mesh.region_of[e])].push_back(static_cast<int>(e) + 1);
  AbaqusNames names(losses);
  for (std::size_t r = 0; r < members.size(); ++r)
    add_set(lines, "ELSET", names.give(mesh.region_names[r]), members[r]);
}

void add_node_sets(TextLines& lines, const Mesh& mesh, Warnings& losses) {
  AbaqusNames names(losses);
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::vector<int> numbers = nodes;
    for (int& n : numbers) ++n;
    add_set(lines, "NSET", names.give(name), numbers);
  }
}

void add_surfaces(TextLines& lines, const Mesh& mesh, Warnings& losses) {
  if (mesh.surfaces.empty()) return;
  AbaqusNames names(losses);
  const std::vector<MeshFace> faces = sorted_faces(mesh);
  for (const auto& [name, listed] : mesh.surfaces) {
    lines.line("*SURFACE", "TYPE=ELEMENT", "NAME=" + quoted_if_needed(names.give(name)));
    for (const FaceCorners& face : listed) {
      const auto [element, side] = element_and_side(mesh, faces, face);
      lines.line(element, "S" + std::to_string(side));
    }
  }
}

}  // namespace

WrittenMesh write_abaqus(const LoadedMesh& loaded) {
  WrittenMesh written;
  TextLines lines(", ");
  add_abaqus_mesh(lines, loaded.mesh);
  add_regions(lines, loaded.mesh, written.losses);
  add_node_sets(lines, loaded.mesh, written.losses);
  add_surfaces(lines, loaded.mesh, written.losses);
  written.files.push_back({".inp", lines.take()});
  return written;
}

}  // namespace orthodyn
