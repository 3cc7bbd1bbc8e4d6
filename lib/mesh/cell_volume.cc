#include "lib/mesh/cell_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "lib/mesh/element_of_shape.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

struct GaussPoint {
  double x, weight;  // on [0, 1]
};
const std::array<GaussPoint, 3> kGauss{
    {{0.5 - std::sqrt(0.15), 5. / 18}, {0.5, 8. / 18}, {0.5 + std::sqrt(0.15), 5. / 18}}};

// Shape functions of the nodes at 0, 1/2 and 1: values and slopes.
std::array<double, 3> quadratics(double x) { return {(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)}; }
std::array<double, 3> quadratic_slopes(double x) { return {4 * x - 3, 4 - 8 * x, 4 * x - 1}; }

// int x . n dA over a quadrilateral, where x[i][j] is the node at (i/2, j/2).
double flux_of_quadrilateral(const std::array<std::array<Vec3, 3>, 3>& x) {
  double sum = 0;
  for (const auto& [u, wu] : kGauss)
    for (const auto& [v, wv] : kGauss) {
      const auto N = quadratics(u), M = quadratics(v), dN = quadratic_slopes(u), dM = quadratic_slopes(v);
      Vec3 at = Vec3::Zero(), by_u = Vec3::Zero(), by_v = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          at += N[i] * M[j] * x[i][j];
          by_u += dN[i] * M[j] * x[i][j];
          by_v += N[i] * dM[j] * x[i][j];
        }
      sum += wu * wv * at.dot(by_u.cross(by_v));
    }
  return sum;
}

// int x . n dA over a triangle with the corners c; m[k] is the middle of the edge from c[k] to the next corner.
// Collapsed coordinates: L = (1 - u - w, u, w) with w = v (1 - u).
double flux_of_triangle(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m) {
  double sum = 0;
  for (const auto& [u, wu] : kGauss)
    for (const auto& [v, wv] : kGauss) {
      const std::array<double, 3> L{(1 - u) * (1 - v), u, v * (1 - u)};
      Vec3 at = Vec3::Zero();
      std::array<Vec3, 3> by{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        at += L[k] * (2 * L[k] - 1) * c[k] + 4 * L[k] * L[next] * m[k];
        by[k] += (4 * L[k] - 1) * c[k] + 4 * L[next] * m[k];
        by[next] += 4 * L[k] * m[k];
      }
      sum += wu * wv * (1 - u) * at.dot((by[1] - by[0]).cross(by[2] - by[0]));
    }
  return sum;
}

// The node in the middle of a quadrilateral of eight nodes: corners x, mid-edge nodes m.
Vec3 serendipity_middle(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& m) {
  return -0.25 * (x[0] + x[1] + x[2] + x[3]) + 0.5 * (m[0] + m[1] + m[2] + m[3]);
}

std::array<std::array<Vec3, 3>, 3> grid_of(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& m,
                                           const Vec3& middle) {
  return {{{x[0], m[3], x[3]}, {m[0], middle, m[2]}, {x[1], m[1], x[2]}}};
}

double volume_by_faces(const Mesh& mesh, std::size_t c) {
  const auto nodes = mesh.cells[c];
  const CellTopology& cell = topology(mesh.cells.shape(c));
  double sum = 0;
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const std::vector<int>& face = cell.faces[f];
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.node(nodes[static_cast<std::size_t>(face[k])]); };
    const auto corners = static_cast<std::size_t>(cell.corners_of_face(f));
    std::array<Vec3, 4> x, m;
    for (std::size_t k = 0; k < corners; ++k) {
      x[k] = at(k);
      m[k] = cell.order == 2 ? at(corners + k) : Vec3((at(k) + at((k + 1) % corners)) / 2);
    }
    sum += corners == 3                ? flux_of_triangle({x[0], x[1], x[2]}, {m[0], m[1], m[2]})
           : face.size() > 2 * corners ? flux_of_quadrilateral(grid_of(x, m, at(2 * corners)))
                                       : flux_of_quadrilateral(grid_of(x, m, serendipity_middle(x, m)));
  }
  return sum / 3;
}

}  // namespace

double cell_volume(const Mesh& mesh, std::size_t cell) {
  const auto nodes = mesh.cells[cell];
  if (mesh.cells.shape(cell) == CellShape::tet4)
    return signed_volume6(mesh, {nodes[0], nodes[1], nodes[2], nodes[3]}) / 6;
  if (mesh.cells.shape(cell) == CellShape::tet10) return Tet10::mass(positions<Tet10>(mesh, cell), 1);
  return volume_by_faces(mesh, cell);
}

double volume_of(const FileCell& cell, const std::function<const Vec3&(std::int64_t)>& position) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
  for (const FileEdge& edge : cell.edges) middles.emplace(std::minmax(edge.a, edge.b), edge.middle);
  if (cell.midsides)
    for (std::size_t e = 0; e < kTetEdges.size(); ++e)
      middles.emplace(std::minmax(cell.nodes[kTetEdges[e][0]], cell.nodes[kTetEdges[e][1]]), (*cell.midsides)[e]);
  const auto middle = [&](std::int64_t a, std::int64_t b) -> Vec3 {
    const auto found = middles.find(std::minmax(a, b));
    return found == middles.end() ? Vec3((position(a) + position(b)) / 2) : position(found->second);
  };
  double sum = 0;
  for (const CornerIndices& face : faces_of(cell.kind)) {
    std::array<std::int64_t, 4> n{};
    std::array<Vec3, 4> c, m;
    for (std::size_t k = 0; k < face.size(); ++k) n[k] = cell.nodes[face[k]];
    for (std::size_t k = 0; k < face.size(); ++k) {
      c[k] = position(n[k]);
      m[k] = middle(n[k], n[(k + 1) % face.size()]);
    }
    if (face.size() == 3) {
      sum -= flux_of_triangle({c[0], c[1], c[2]}, {m[0], m[1], m[2]});  // nodes are clockwise from outside
      continue;
    }
    const auto own = middles.find(std::minmax(n[0], n[2]));
    const Vec3 centre = own == middles.end() ? serendipity_middle(c, m) : position(own->second);
    sum -= flux_of_quadrilateral(grid_of(c, m, centre));
  }
  return sum / 3;
}

}  // namespace orthodyn
