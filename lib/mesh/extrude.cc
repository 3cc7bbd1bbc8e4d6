#include "lib/mesh/extrude.h"

#include <algorithm>
#include <utility>

namespace orthodyn {

Mesh extrude(const PlaneMesh& plane, double length, int layers) {
  const int per_layer = static_cast<int>(plane.nodes.size());
  Mesh mesh;
  for (int layer = 0; layer <= layers; ++layer)
    for (const auto& [x, y] : plane.nodes) mesh.nodes.push_back({x, y, length * layer / layers});
  std::vector<Tet> tets;
  for (int layer = 0; layer < layers; ++layer) {
    const bool mirrored = layer % 2 == 1;
    const int bottom = (mirrored ? layer + 1 : layer) * per_layer;
    const int top = (mirrored ? layer : layer + 1) * per_layer;
    for (Triangle t : plane.triangles) {
      std::sort(t.begin(), t.end());
      const auto [a, b, c] = t;
      for (Tet tet : {Tet{bottom + a, bottom + b, bottom + c, top + c}, Tet{bottom + a, bottom + b, top + b, top + c},
                      Tet{bottom + a, top + a, top + b, top + c}}) {
        if (signed_volume6(mesh, tet) < 0) std::swap(tet[2], tet[3]);
        tets.push_back(tet);
      }
    }
  }
  mesh.cells = Cells(tets);
  for (int layer = 0; layer < layers; ++layer)
    for (const auto& [a, b, c, d] : plane.quadrilaterals) {
      const int bottom = layer * per_layer, top = bottom + per_layer;
      mesh.cells.add(CellShape::hex8,
                     std::array{bottom + a, bottom + b, bottom + c, bottom + d, top + a, top + b, top + c, top + d});
    }
  mesh.region_of.assign(mesh.cells.size(), 0);
  mesh.region_names = {"body"};
  return mesh;
}

}  // namespace orthodyn
