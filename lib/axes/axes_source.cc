#include "lib/axes/axes_source.h"

namespace orthodyn {

Vec3 centroid(const TetMesh& mesh, int cell) {
  Vec3 sum = Vec3::Zero();
  for (const int node : mesh.tets[static_cast<std::size_t>(cell)]) sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / 4;
}

ElementAxes element_axes(const AxesSource& source, const AxesField& field, const TetMesh& mesh,
                         const std::vector<int>& cells) {
  if (source.uniform()) return field(centroid(mesh, cells.front()), cells.front());
  std::vector<Mat3> each;
  each.reserve(cells.size());
  for (const int cell : cells) each.push_back(field(centroid(mesh, cell), cell));
  return ElementAxes(each);
}

}  // namespace orthodyn
