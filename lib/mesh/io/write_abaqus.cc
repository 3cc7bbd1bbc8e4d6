// Abaqus: one block of C3D4, then the sets.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "lib/mesh/io/mesh_writer.h"
#include "lib/mesh/tet_faces.h"

namespace orthodyn {
namespace {

constexpr std::size_t kFaces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};  // S1 to S4 of C3D4

// Within quotes only these cannot stand, and blanks at the edges are none of the name.
std::string abaqus_name(std::string name) {
  std::replace_if(name.begin(), name.end(), [](char c) { return (c >= '\0' && c < ' ') || c == '"'; }, '_');
  if (!name.empty() && name.front() == ' ') name.front() = '_';
  if (!name.empty() && name.back() == ' ') name.back() = '_';
  return name;
}

// In quotes only where it must be: some readers take the quotes for a part of the name.
std::string quoted_if_needed(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; };
  const bool is_plain = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) &&
                        std::all_of(name.begin(), name.end(), plain);
  return is_plain ? name : "\"" + name + "\"";
}

void add_list(std::string& text, const std::string& keyword, const std::string& name, const std::vector<int>& numbers) {
  text += fmt::format("*{}, {}={}\n", keyword, keyword, quoted_if_needed(name));
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const bool last = k % 16 == 15 || k + 1 == numbers.size();
    text += fmt::format("{}{}", numbers[k], last ? "\n" : ", ");
  }
}

// S1 ... S4 if the triangle is that face of the tet, in this sense of rotation if `oriented`; else 0.
int side_of(const Tet& tet, const Triangle& triangle, bool oriented) {
  for (int side = 0; side < 4; ++side) {
    const auto& f = kFaces[side];
    Triangle face{tet[f[0]], tet[f[1]], tet[f[2]]};
    for (int turn = 0; oriented && turn < 3; ++turn) {
      if (face == triangle) return side + 1;
      std::rotate(face.begin(), face.begin() + 1, face.end());
    }
    Triangle a = face, b = triangle;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (!oriented && a == b) return side + 1;
  }
  return 0;
}

// An inner triangle is a face of two tets; the one that sees it the same way round is named.
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
  return {0, 0};  // not a face: no valid mesh
}

}  // namespace

WrittenMesh write_abaqus(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  std::string text = "*HEADING\nwritten by orthodyn\n*NODE\n";
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3& x = mesh.nodes[n];
    fmt::format_to(std::back_inserter(text), "{}, {}, {}, {}\n", n + 1, x[0], x[1], x[2]);
  }
  text += "*ELEMENT, TYPE=C3D4\n";
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Tet& t = mesh.tets[e];
    fmt::format_to(std::back_inserter(text), "{}, {}, {}, {}, {}\n", e + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  WrittenMesh written;
  std::vector<std::vector<int>> members(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    members[static_cast<std::size_t>(mesh.region_of[e])].push_back(static_cast<int>(e) + 1);
  }
  const auto named = [&](TakenNames& taken, const std::string& name) {
    return unique_name(taken, name, abaqus_name(name), written);
  };
  TakenNames element_sets{.capitals_differ = false}, node_sets = element_sets, surfaces = element_sets;
  for (std::size_t r = 0; r < members.size(); ++r) {
    add_list(text, "ELSET", named(element_sets, mesh.region_names[r]), members[r]);
  }
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::vector<int> tags;
    for (const int n : nodes) tags.push_back(n + 1);
    add_list(text, "NSET", named(node_sets, name), tags);
  }
  if (!mesh.surfaces.empty()) {
    const std::vector<TetFace> faces = sorted_faces(mesh);
    for (const auto& [name, triangles] : mesh.surfaces) {
      text += fmt::format("*SURFACE, TYPE=ELEMENT, NAME={}\n", quoted_if_needed(named(surfaces, name)));
      for (const Triangle& t : triangles) {
        const auto [element, side] = element_and_side(mesh, faces, t);
        text += fmt::format("{}, S{}\n", element, side);
      }
    }
  }
  written.files.push_back({".inp", std::move(text)});
  note_lost_materials_and_data(written, loaded);
  return written;
}

}  // namespace orthodyn
