#include "lib/material_axes/axes_source.h"

namespace orthodyn {

ElementAxes element_axes(const AxesSource& source, const AxesField& field, const ElementMesh& mesh,
                         const std::vector<int>& cells) {
  const auto points_of = [&](int cell) {
    const auto c = static_cast<std::size_t>(cell);
    return mesh.type(c).points(mesh.positions(c));
  };
  const ElementType::Nodes first = points_of(cells.front());
  if (source.uniform()) return field(first.col(0), cells.front());
  std::vector<Mat3> each;
  each.reserve(cells.size() * static_cast<std::size_t>(first.cols()));
  for (const int cell : cells) {
    const ElementType::Nodes points = points_of(cell);
    for (Eigen::Index p = 0; p < points.cols(); ++p) each.push_back(field(points.col(p), cell));
  }
  return ElementAxes(each, static_cast<int>(first.cols()));
}

}  // namespace orthodyn
