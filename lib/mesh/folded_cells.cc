#include "lib/mesh/folded_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lib/core/errors.h"
#include "lib/mesh/element_of_shape.h"

namespace orthodyn {

namespace {

constexpr double kFolded = 1e-6;  // smallest ratio of the Jacobian's determinant to its reference

// The Jacobian of an element's map must keep its orientation at all evaluation points. It is constant in a tetrahedron
// with straight edges.
template <class E>
double smallest_jacobian(const ElementNodes<E::kNodes>& X) {
  const NodeDifferences<E::kNodes> rest = differences<E::kNodes>(X);
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& place : E::checked_places()) smallest = std::min(smallest, E::jacobian(rest, place).determinant());
  return smallest;
}

bool has_straight_edges(const ElementNodes<Tet10::kNodes>& X) {
  for (int e = 0; e < 6; ++e) {
    const auto [i, j] = Tet10::kEdges[static_cast<std::size_t>(e)];
    if ((X.col(4 + e) - 0.5 * (X.col(i) + X.col(j))).norm() > 1e-12 * (X.col(i) - X.col(j)).norm()) return false;
  }
  return true;
}

}  // namespace

void check_folding(const Mesh& mesh, const MeshOrigin& origin) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    double smallest = 1;
    with_element(mesh.cells.shape(c), [&]<class E>() {
      const auto X = positions<E>(mesh, c);
      if constexpr (std::is_same_v<E, Tet10>) {
        if (has_straight_edges(X)) return;
        const auto corners = mesh.cells.corners(c);
        smallest = smallest_jacobian<E>(X) / signed_volume6(mesh, {corners[0], corners[1], corners[2], corners[3]});
      } else if constexpr (!std::is_same_v<E, Tet4>) {
        const double reference_volume = mesh.cells.corners(c).size() == 8 ? 8 : 1;  // of the hexahedron, of the wedge
        smallest = smallest_jacobian<E>(X) / (E::mass(X, 1) / reference_volume);
      }
    });
    if (smallest > kFolded) continue;
    const int cell = static_cast<int>(c);
    if (mesh.cells.shape(c) == CellShape::tet10)
      throw ConfigError(
          origin.cell(cell),
          fmt::format("its curved edges fold it over (det dX/dL is {:.3g} of that with straight edges); remesh finer, "
                      "straighten it (Gmsh: Mesh.SecondOrderLinear = 1), or optimise it (Gmsh: Mesh.HighOrderOptimize)",
                      smallest));
    throw ConfigError(
        origin.cell(cell),
        fmt::format("folded over: at one of its points the determinant of the Jacobian is {:.3g} of its mean; remesh, "
                    "or try `split: true`, which accepts it if its tetrahedra all have a positive volume",
                    smallest));
  }
}

}  // namespace orthodyn
