#include "lib/mesh/cell_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

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

}  // namespace

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
    const Vec3 centre = own == middles.end()
                            ? Vec3(-0.25 * (c[0] + c[1] + c[2] + c[3]) + 0.5 * (m[0] + m[1] + m[2] + m[3]))
                            : position(own->second);
    sum -= flux_of_quadrilateral({{{c[0], m[3], c[3]}, {m[0], centre, m[2]}, {c[1], m[1], c[2]}}});
  }
  return sum / 3;
}

}  // namespace orthodyn
