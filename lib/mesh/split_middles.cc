#include "lib/mesh/split_middles.h"

#include <algorithm>

#include "lib/mesh/quadratic.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {

namespace {

Vec3 sum_of(const Mesh& mesh, const std::vector<int>& nodes) {
  Vec3 sum = Vec3::Zero();
  for (const int n : nodes) sum += mesh.nodes[static_cast<std::size_t>(n)];
  return sum;
}

}  // namespace

void SplitMiddles::add_edges(std::span<const EdgeMiddle> edges) {
  for (const auto& [a, b, middle] : edges)
    if (a != b) middles_.emplace(edge_key(a, b), middle);
}

void SplitMiddles::add_diagonal(int a, int b, const Diagonal& diagonal) {
  if (!middles_.contains(edge_key(a, b))) diagonals_.emplace(edge_key(a, b), diagonal);
}

// Faces with repeated corners are triangles and have no diagonal.
void SplitMiddles::add_diagonals(CellKind kind, std::span<const int> corners) {
  const auto middles_around = [&](const std::vector<int>& loop, std::vector<int>& all) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto found = middles_.find(edge_key(loop[k], loop[(k + 1) % loop.size()]));
      if (found != middles_.end()) all.push_back(found->second);
    }
  };
  Diagonal whole{{corners.begin(), corners.end()}, {}, false};
  for (const CornerIndices& places : faces_of(kind)) {
    std::vector<int> face;
    for (const std::size_t k : places) face.push_back(corners[k]);
    middles_around(face, whole.middles);
    if (face.size() != 4) continue;
    Diagonal of_face{face, {}, true};
    middles_around(face, of_face.middles);
    if (of_face.middles.size() != 4) continue;
    add_diagonal(face[0], face[2], of_face);
    add_diagonal(face[1], face[3], of_face);
  }
  std::sort(whole.middles.begin(), whole.middles.end());
  whole.middles.erase(std::unique(whole.middles.begin(), whole.middles.end()), whole.middles.end());
  if (kind != CellKind::hexahedron || whole.middles.size() != 12) return;
  for (std::size_t k = 0; k < 4; ++k) add_diagonal(corners[k], corners[4 + (k + 2) % 4], whole);
}

// Places a new node by the serendipity shape functions of 8 and 20 nodes at the centre: -1/4 for corners, 1/2 and 1/4
// for mid-edge nodes.
int SplitMiddles::middle(int a, int b) {
  const auto [entry, is_new] = middles_.try_emplace(edge_key(a, b), static_cast<int>(mesh_.nodes.size()));
  if (!is_new) return entry->second;
  const auto found = diagonals_.find(edge_key(a, b));
  if (found == diagonals_.end()) {
    mesh_.nodes.push_back(0.5 * sum_of(mesh_, {a, b}));
    return entry->second;
  }
  const Diagonal& diagonal = found->second;
  mesh_.nodes.push_back(-0.25 * sum_of(mesh_, diagonal.corners) +
                        (diagonal.is_face ? 0.5 : 0.25) * sum_of(mesh_, diagonal.middles));
  if (diagonal.is_face) new_on_faces_.emplace_back(entry->second, diagonal);
  return entry->second;
}

Midsides SplitMiddles::of(const Tet& tet) {
  Midsides out{};
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) out[e] = middle(tet[kTetEdges[e][0]], tet[kTetEdges[e][1]]);
  return out;
}

void SplitMiddles::complete_node_sets() {
  for (auto& [name, set] : mesh_.node_sets) {
    std::vector<char> is_in(mesh_.nodes.size(), 0);
    for (const int node : set) is_in[static_cast<std::size_t>(node)] = 1;
    const auto has = [&](int node) { return is_in[static_cast<std::size_t>(node)] != 0; };
    for (const auto& [node, face] : new_on_faces_)
      if (std::all_of(face.corners.begin(), face.corners.end(), has) &&
          std::all_of(face.middles.begin(), face.middles.end(), has))
        set.push_back(node);
  }
}

}  // namespace orthodyn
