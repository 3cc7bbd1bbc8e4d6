// Implements write_abaqus(): nodes, one block of C3D4 or C3D10, then sets and surfaces.
#include <algorithm>
#include <cctype>
#include <span>
#include <utility>

#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/abaqus_file.h"
#include "lib/mesh/io/text_lines.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/split_cells.h"
#include "lib/mesh/tet_faces.h"

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

// 1 to 4 for S1 to S4 if the triangle is that face of the tet (with the same orientation if `oriented`), otherwise 0.
int side_of(const Tet& tet, const Triangle& triangle, bool oriented) {
  for (std::size_t side = 0; side < 4; ++side) {
    const CornerIndices& places = faces_of(CellKind::tet)[side];
    Triangle face{tet[places[0]], tet[places[1]], tet[places[2]]};
    for (int turn = 0; oriented && turn < 3; ++turn) {
      if (face == triangle) return static_cast<int>(side) + 1;
      std::rotate(face.begin(), face.begin() + 1, face.end());
    }
    Triangle a = face, b = triangle;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (!oriented && a == b) return static_cast<int>(side) + 1;
  }
  return 0;
}

// The number (from 1) of a tet and the side, 1 to 4, that is this triangle. For an inner triangle, the tet on which it
// has the same orientation is preferred.
std::pair<int, int> element_and_side(const TetMesh& mesh, const std::vector<TetFace>& faces, const Triangle& triangle) {
  Triangle key = triangle;
  sort_nodes(key);
  const auto before = [](const TetFace& face, const Triangle& k) { return face.nodes < k; };
  const auto begin = std::lower_bound(faces.begin(), faces.end(), key, before);
  for (const bool oriented : {true, false}) {
    for (auto it = begin; it != faces.end() && it->nodes == key; ++it) {
      const int side = side_of(mesh.tets[static_cast<std::size_t>(it->tet)], triangle, oriented);
      if (side > 0) return {it->tet + 1, side};
    }
  }
  return {0, 0};  // not a face: the mesh is invalid
}

void add_abaqus_mesh(TextLines& lines, const TetMesh& mesh) {
  lines.text("*HEADING\nwritten by orthodyn\n*NODE\n");
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) lines.line(n + 1, mesh.nodes[n]);
  lines.text(mesh.order() == 1 ? "*ELEMENT, TYPE=C3D4\n" : "*ELEMENT, TYPE=C3D10\n");
  const Cells cells = tet_cells(mesh);
  for (std::size_t e = 0; e < cells.size(); ++e) lines.line(e + 1, FromOne{cells[e]});
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

void add_regions(TextLines& lines, const TetMesh& mesh, Warnings& losses) {
  std::vector<std::vector<int>> members(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    members[static_cast<std::size_t>(mesh.region_of[e])].push_back(static_cast<int>(e) + 1);
  AbaqusNames names(losses);
  for (std::size_t r = 0; r < members.size(); ++r)
    add_set(lines, "ELSET", names.give(mesh.region_names[r]), members[r]);
}

void add_node_sets(TextLines& lines, const TetMesh& mesh, Warnings& losses) {
  AbaqusNames names(losses);
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::vector<int> numbers = nodes;
    for (int& n : numbers) ++n;
    add_set(lines, "NSET", names.give(name), numbers);
  }
}

void add_surfaces(TextLines& lines, const TetMesh& mesh, Warnings& losses) {
  if (mesh.surfaces.empty()) return;
  AbaqusNames names(losses);
  const std::vector<TetFace> faces = sorted_faces(mesh);
  for (const auto& [name, triangles] : mesh.surfaces) {
    lines.line("*SURFACE", "TYPE=ELEMENT", "NAME=" + quoted_if_needed(names.give(name)));
    for (const Triangle& t : triangles) {
      const auto [element, side] = element_and_side(mesh, faces, t);
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
