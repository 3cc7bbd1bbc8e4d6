#include "lib/mesh/tet_faces.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace orthodyn {
namespace {

// Local nodes of the faces of a positive tet, counterclockwise from outside.
constexpr int kFaceNodes[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

TetFace face_of(const Tet& tet, int index, int local) {
  TetFace face{};
  for (std::size_t i = 0; i < 3; ++i) face.nodes[i] = tet[static_cast<std::size_t>(kFaceNodes[local][i])];
  face.flipped = sort_nodes(face.nodes);
  face.tet = index;
  return face;
}

// Start of the faces with a given lowest node; one more entry than nodes.
std::vector<std::size_t> bucket_starts(const TetMesh& mesh) {
  std::vector<std::size_t> starts(mesh.nodes.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int local = 0; local < 4; ++local) {
      const TetFace face = face_of(mesh.tets[t], static_cast<int>(t), local);
      ++starts[static_cast<std::size_t>(face.nodes[0]) + 1];
    }
  }
  for (std::size_t n = 1; n < starts.size(); ++n) starts[n] += starts[n - 1];
  return starts;
}

}  // namespace

bool sort_nodes(Triangle& nodes) {
  bool odd = false;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (nodes[i] > nodes[j]) {
      std::swap(nodes[i], nodes[j]);
      odd = !odd;
    }
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return odd;
}

// Counting sort by the lowest node, then a sort in each bucket of about 20 faces: several times faster than one sort
// for millions of tets.
std::vector<TetFace> sorted_faces(const TetMesh& mesh) {
  const std::vector<std::size_t> starts = bucket_starts(mesh);
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  std::vector<TetFace> faces(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int local = 0; local < 4; ++local) {
      const TetFace face = face_of(mesh.tets[t], static_cast<int>(t), local);
      faces[next[static_cast<std::size_t>(face.nodes[0])]++] = face;
    }
  }
  const auto before = [](const TetFace& a, const TetFace& b) {
    return std::tie(a.nodes, a.flipped, a.tet) < std::tie(b.nodes, b.flipped, b.tet);
  };
  for (std::size_t n = 0; n + 1 < starts.size(); ++n)
    std::sort(faces.begin() + static_cast<std::ptrdiff_t>(starts[n]),
              faces.begin() + static_cast<std::ptrdiff_t>(starts[n + 1]), before);
  return faces;
}

std::size_t end_of_face(const std::vector<TetFace>& faces, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < faces.size() && faces[end].nodes == faces[begin].nodes) ++end;
  return end;
}

}  // namespace orthodyn
