#include "lib/mesh/mesh_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "lib/mesh/mesh_draft_warnings.h"
#include "lib/mesh/node_numbers.h"
#include "lib/mesh/split_cells.h"
#include "lib/mesh/split_middles.h"
#include "lib/mesh/whole_cells.h"

namespace orthodyn {
namespace {

void sort_by_tag(MeshDraft& draft) {
  std::vector<FileNode>& nodes = draft.nodes;
  constexpr auto kMax = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (nodes.size() > kMax) draft.fail({}, "{} nodes; at most {} can be numbered", nodes.size(), kMax);
  const auto before = [](const FileNode& a, const FileNode& b) { return a.tag < b.tag; };
  if (!std::is_sorted(nodes.begin(), nodes.end(), before)) std::stable_sort(nodes.begin(), nodes.end(), before);
  const auto same = std::adjacent_find(nodes.begin(), nodes.end(),
                                       [](const FileNode& a, const FileNode& b) { return a.tag == b.tag; });
  if (same == nodes.end()) return;
  draft.fail((same + 1)->place, "node tag {} is defined twice (first in line {})", same->tag, same->place.line);
}

// By surface: for each triangle, the index of the face in the file that it was cut from.
using FaceOrigins = std::map<std::string, std::vector<std::size_t>>;

template <std::size_t N>
void number_into(std::array<int, N>& numbers, const MeshDraft& draft, const NodeNumbers& number, const auto& element,
                 std::span<const std::int64_t> tags) {
  for (std::size_t i = 0; i < tags.size(); ++i) {
    numbers[i] = number(tags[i]);
    if (numbers[i] >= 0) continue;
    draft.fail(element.place, "element {}: node {} is not defined in {}", element.tag, tags[i], draft.nodes_section);
  }
}

void check_order(const MeshDraft& draft) {
  for (const FileCell& cell : draft.cells) {
    if (cell.is_quadratic() == draft.cells.front().is_quadratic()) continue;
    draft.fail(cell.place, "element {} is {}, earlier ones are not; all must be of one order", cell.tag,
               cell.is_quadratic() ? "quadratic" : "linear");
  }
}

using FaceTags = std::array<std::int64_t, 3>;  // ascending

// Faces of the tets in the file, ascending, each with the index of its cell.
std::vector<std::pair<FaceTags, std::size_t>> faces_of_tets(const MeshDraft& draft) {
  std::vector<std::pair<FaceTags, std::size_t>> faces;
  for (std::size_t c = 0; c < draft.cells.size(); ++c) {
    if (draft.cells[c].kind != CellKind::tet) continue;
    for (const CornerIndices& places : faces_of(CellKind::tet)) {
      FaceTags face{};
      for (std::size_t k = 0; k < 3; ++k) face[k] = draft.cells[c].nodes[places[k]];
      std::sort(face.begin(), face.end());
      faces.emplace_back(face, c);
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

// Calls visit(quadrilateral, cell) for each quadrilateral of each cell, with the smallest node tag first.
// Quadrilaterals that are collapsed to triangles are left out.
template <class Visit>
void for_each_quadrilateral(const MeshDraft& draft, Visit&& visit) {
  for (const FileCell& cell : draft.cells)
    for (const CornerIndices& places : faces_of(cell.kind)) {
      if (places.size() != 4) continue;
      std::array<std::int64_t, 4> quad{};
      for (std::size_t k = 0; k < 4; ++k) quad[k] = cell.nodes[places[k]];
      if (std::set(quad.begin(), quad.end()).size() < 4) continue;
      std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
      visit(quad, cell);
    }
}

// The cell of the tet that has this face, or null. `faces`: faces_of_tets().
const FileCell* tet_at(const MeshDraft& draft, const std::vector<std::pair<FaceTags, std::size_t>>& faces,
                       FaceTags face) {
  std::sort(face.begin(), face.end());
  const auto found = std::lower_bound(faces.begin(), faces.end(), std::pair(face, std::size_t{0}));
  return found == faces.end() || found->first != face ? nullptr : &draft.cells[found->second];
}

bool has_tets_only(const MeshDraft& draft) {
  return std::all_of(draft.cells.begin(), draft.cells.end(),
                     [](const FileCell& cell) { return cell.kind == CellKind::tet; });
}

// Whether a tet of the file lies on a quadrilateral: the two match only if all elements are split.
bool has_tet_on_quadrilateral(const MeshDraft& draft) {
  if (has_tets_only(draft)) return false;
  const auto faces = faces_of_tets(draft);
  if (faces.empty()) return false;
  bool found = false;
  for_each_quadrilateral(draft, [&](const std::array<std::int64_t, 4>& q, const FileCell&) {
    for (std::size_t k = 0; k < 4; ++k)
      found = found || tet_at(draft, faces, {q[k], q[(k + 1) % 4], q[(k + 2) % 4]}) != nullptr;
  });
  return found;
}

// A tet of the file that lies on a quadrilateral must match one of the two triangles that the face is cut into.
void check_diagonals(const MeshDraft& draft) {
  if (has_tets_only(draft)) return;
  const auto faces = faces_of_tets(draft);
  if (faces.empty()) return;
  for_each_quadrilateral(draft, [&](const std::array<std::int64_t, 4>& quad, const FileCell& cell) {
    for (const std::size_t third : {0u, 2u}) {  // the halves of the face if it were cut by the other diagonal
      const FileCell* const tet = tet_at(draft, faces, {quad[1], quad[3], quad[third]});
      if (!tet) continue;
      draft.fail(tet->place,
                 "element {}: one of its triangles lies on a quadrilateral of element {} ({}), which is divided along "
                 "the other diagonal, from node {} to {}; mesh with pyramids between them",
                 tet->tag, cell.tag, draft.where(cell.place), quad[0], quad[2]);
    }
  });
}

// Tetrahedra, with their mid-edge nodes in a quadratic mesh.
struct Tets {
  std::vector<Tet> corners = {};
  std::vector<Midsides> middles = {};

  Cells cells() const {
    if (middles.empty()) return Cells(corners);
    Cells out;
    out.reserve(corners.size(), 10);
    std::array<int, 10> nodes{};
    for (std::size_t t = 0; t < corners.size(); ++t) {
      std::copy(corners[t].begin(), corners[t].end(), nodes.begin());
      std::copy(middles[t].begin(), middles[t].end(), nodes.begin() + 4);
      out.add(CellShape::tet10, nodes);
    }
    return out;
  }
};

void add_tets(const MeshDraft& draft, const NodeNumbers& number, Mesh& mesh, Tets& tets) {
  std::array<int, 8> nodes{};
  for (std::size_t c = 0; c < draft.cells.size(); ++c) {
    const FileCell& cell = draft.cells[c];
    number_into(nodes, draft, number, cell, cell.corners());
    if (!append_tets(cell.kind, {nodes.data(), corners_of(cell.kind)}, tets.corners))
      draft.fail(cell.place,
                 "element {}: a {} with repeated nodes that cannot be split into tetrahedra; nodes may be repeated "
                 "along edges only: remesh",
                 cell.tag, name_of(cell.kind));
    mesh.region_of.resize(tets.corners.size(), cell.region);
    mesh.cell_of.resize(tets.corners.size(), static_cast<int>(c));
  }
}

std::vector<EdgeMiddle> edges_of(const MeshDraft& draft, const NodeNumbers& number, const FileCell& cell) {
  FileCell all = cell;
  if (cell.midsides) all.add_edge_middles(kTetEdges, *cell.midsides);
  std::vector<EdgeMiddle> out;
  for (const auto& [a, b, middle] : all.edges) {
    std::array<int, 3> nodes{};
    number_into(nodes, draft, number, cell, std::array{a, b, middle});
    out.push_back({nodes[0], nodes[1], nodes[2]});
  }
  return out;
}

// Edges of all elements come before diagonals: a diagonal that is an edge of a tet has its node already.
void add_midsides(const MeshDraft& draft, const NodeNumbers& number, Mesh& mesh, Tets& tets) {
  if (has_tets_only(draft)) {
    for (const FileCell& cell : draft.cells)
      if (cell.midsides) number_into(tets.middles.emplace_back(), draft, number, cell, *cell.midsides);
    return;
  }
  if (!draft.cells.front().is_quadratic()) return;
  SplitMiddles middles(mesh);
  for (const FileCell& cell : draft.cells) middles.add_edges(edges_of(draft, number, cell));
  std::array<int, 8> nodes{};
  for (const FileCell& cell : draft.cells) {
    number_into(nodes, draft, number, cell, cell.corners());
    middles.add_diagonals(cell.kind, {nodes.data(), corners_of(cell.kind)});
  }
  for (const Tet& tet : tets.corners) tets.middles.push_back(middles.of(tet));
  middles.complete_node_sets();
}

void add_whole_cells(const MeshDraft& draft, const NodeNumbers& number, Mesh& mesh) {
  std::array<int, 27> nodes{};
  for (const FileCell& cell : draft.cells) {
    const WholeCell whole = whole_cell(cell);
    number_into(nodes, draft, number, cell, whole.nodes);
    mesh.cell_of.push_back(static_cast<int>(mesh.cells.size()));
    mesh.cells.add(whole.shape, std::span(nodes).first(whole.nodes.size()));
    mesh.region_of.push_back(cell.region);
  }
}

void add_surfaces(const MeshDraft& draft, const NodeNumbers& number, bool keep, Mesh& mesh, FaceOrigins& face_origins) {
  for (const auto& [name, faces] : draft.surfaces) {
    auto& surface = mesh.surfaces[name];
    auto& face_of = face_origins[name];
    std::array<int, 4> nodes{};
    for (std::size_t f = 0; f < faces.size(); ++f) {
      number_into(nodes, draft, number, faces[f], faces[f].corners());
      const auto corners = std::span(nodes).first(faces[f].sides);
      if (keep) surface.emplace_back(corners);
      else append_triangles(corners, surface);
      face_of.resize(surface.size(), f);
    }
  }
}

// `keep`: elements stay as they are; otherwise all become tetrahedra.
Mesh number_nodes(const MeshDraft& draft, bool keep, FaceOrigins& face_origins) {
  const NodeNumbers number(draft.nodes);
  Mesh mesh;
  mesh.region_names = draft.region_names;
  for (const FileNode& node : draft.nodes) mesh.nodes.push_back(node.x);
  Tets tets;
  if (keep) add_whole_cells(draft, number, mesh);
  else add_tets(draft, number, mesh, tets);
  add_surfaces(draft, number, keep, mesh, face_origins);
  for (const auto& [name, uses] : draft.node_sets) {
    auto& set = mesh.node_sets[name];
    for (const FileNodeUse& use : uses) {
      set.push_back(number(use.tag));
      if (set.back() < 0)
        draft.fail(use.place, "node set \"{}\": node {} is not defined in {}", name, use.tag, draft.nodes_section);
    }
  }
  if (keep) return mesh;
  add_midsides(draft, number, mesh, tets);
  mesh.cells = tets.cells();
  return mesh;
}

// A volume whose sign is the orientation of the cell. Mid-edge nodes of a tetrahedron are left out.
double corner_volume(const Mesh& mesh, std::size_t cell) {
  const auto corners = mesh.cells.corners(cell);
  if (corners.size() > 4) return cell_volume(mesh, cell);
  return signed_volume6(mesh, {corners[0], corners[1], corners[2], corners[3]});
}

// Reverses the orientation of the elements whose cells are all inverted; returns these elements.
std::vector<std::size_t> reorient_inverted(Mesh& mesh) {
  std::vector<std::size_t> turned;
  for (std::size_t begin = 0, end = 0; begin < mesh.cells.size(); begin = end) {
    bool all = true;
    for (end = begin; end < mesh.cells.size() && mesh.cell_of[end] == mesh.cell_of[begin]; ++end)
      all = all && corner_volume(mesh, end) < 0;
    if (!all) continue;
    turned.push_back(static_cast<std::size_t>(mesh.cell_of[begin]));
    for (std::size_t c = begin; c < end; ++c) turn_cell(mesh.cells.shape(c), mesh.cells.nodes_of(c));
  }
  return turned;
}

// "element 7", or "element 7, tetrahedron 2 of 6 of a hexahedron".
std::string tet_name_of(const MeshDraft& draft, const Mesh& mesh, int tet) {
  const auto t = static_cast<std::size_t>(tet);
  const FileCell& cell = draft.cells[static_cast<std::size_t>(mesh.cell_of[t])];
  const std::string name = fmt::format("{}: element {}", draft.where(cell.place), cell.tag);
  const auto [begin, end] = std::equal_range(mesh.cell_of.begin(), mesh.cell_of.end(), mesh.cell_of[t]);
  if (cell.kind == CellKind::tet || end == begin + 1) return name;
  return fmt::format("{}, tetrahedron {} of {} of a {}", name, mesh.cell_of.begin() + tet - begin + 1, end - begin,
                     name_of(cell.kind));
}

MeshOrigin origin_of(const MeshDraft& draft, const Mesh& mesh, const FaceOrigins& face_origins) {
  return {
      .source = draft.files.front(),
      .cell_name = [&](int t) { return tet_name_of(draft, mesh, t); },
      .node_name = [&draft](int n) -> std::string {
        if (static_cast<std::size_t>(n) >= draft.nodes.size())
          return draft.files.front() + ": a node added when an element was split";
        const FileNode& node = draft.nodes[static_cast<std::size_t>(n)];
        return fmt::format("{}: node {}", draft.where(node.place), node.tag);
      },
      .face_name =
          [&](const std::string& surface, int k) {
            const std::size_t f = face_origins.at(surface)[static_cast<std::size_t>(k)];
            const FileFace& face = draft.surfaces.at(surface)[f];
            return fmt::format("{}: element {}", draft.where(face.place), face.tag);
          },
  };
}

}  // namespace

void FileCell::add_edge_middles(std::span<const std::array<std::size_t, 2>> corners_of_edges,
                                std::span<const std::int64_t> middles) {
  for (std::size_t e = 0; e < corners_of_edges.size(); ++e)
    edges.push_back({nodes[corners_of_edges[e][0]], nodes[corners_of_edges[e][1]], middles[e]});
}

void FileCell::add_face_middle(const std::array<std::size_t, 4>& places, std::int64_t middle) {
  const std::array<std::int64_t, 4> n{nodes[places[0]], nodes[places[1]], nodes[places[2]], nodes[places[3]]};
  if (std::set(n.begin(), n.end()).size() < 4) return;  // collapsed to a triangle
  edges.push_back({n[0], n[2], middle});
  edges.push_back({n[1], n[3], middle});
}

void FileCell::add_centre(std::int64_t middle) {
  if (std::set(nodes.begin(), nodes.end()).size() < 8) return;
  for (std::size_t k = 0; k < 4; ++k) edges.push_back({nodes[k], nodes[4 + (k + 2) % 4], middle});
}

int MeshDraft::region_index(const std::string& name) {
  const auto [entry, is_new] = region_indices.emplace(name, static_cast<int>(region_names.size()));
  if (is_new) region_names.push_back(name);
  return entry->second;
}

std::string MeshDraft::where(FilePlace place) const {
  const std::string& file = files[static_cast<std::size_t>(place.file)];
  return place.line > 0 ? fmt::format("{}:{}", file, place.line) : file;
}

LoadedMesh build_mesh(MeshDraft draft, FileCells cells) {
  sort_by_tag(draft);
  check_order(draft);
  const bool keep = can_keep_cells(draft, cells) && !has_tet_on_quadrilateral(draft);
  if (!keep) check_diagonals(draft);
  FaceOrigins face_origins;
  LoadedMesh loaded{.mesh = number_nodes(draft, keep, face_origins), .warnings = std::move(draft.warnings)};
  const auto warn = [&](std::string warning) {
    if (!warning.empty()) loaded.warnings.push_back(std::move(warning));
  };
  warn(inverted_warning(draft, reorient_inverted(loaded.mesh)));
  const std::string split = keep ? "" : split_warning(draft, loaded.mesh.cells.size());
  warn(split);
  const Warnings found = validate(loaded.mesh, origin_of(draft, loaded.mesh, face_origins));
  if (!split.empty()) warn(volume_warning(draft, loaded.mesh));
  if (split.empty()) loaded.mesh.cell_of.clear();
  loaded.warnings.insert(loaded.warnings.end(), found.begin(), found.end());
  return loaded;
}

}  // namespace orthodyn
