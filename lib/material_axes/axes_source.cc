#include "lib/material_axes/axes_source.h"

namespace orthodyn {

ElementAxes element_axes(const AxesSource& source, const AxesField& field, const ElementType& type,
                         const ElementMesh& mesh, const std::vector<int>& cells) {
  const auto points_of = [&](int cell) { return type.points(mesh.positions(static_cast<std::size_t>(cell))); };
  if (source.uniform()) return field(points_of(cells.front()).col(0), cells.front());
  std::vector<Mat3> each;
  each.reserve(cells.size() * static_cast<std::size_t>(type.num_points()));
  for (const int cell : cells) {
    const Eigen::Matrix3Xd points = points_of(cell);
    for (Eigen::Index p = 0; p < points.cols(); ++p) each.push_back(field(points.col(p), cell));
  }
  return ElementAxes(each, type.num_points());
}

}  // namespace orthodyn
