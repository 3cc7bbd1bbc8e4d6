#include "lib/mesh/io/abaqus_axes.h"

#include <numbers>

#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {

AbaqusAxes::AbaqusAxes(const AbaqusFile& file, const AbaqusOrientation& orientation, AbaqusLookup& lookup)
    : file_(file), orientation_(orientation), points_(orientation.points) {
  for (std::size_t k = 0; k < orientation.nodes.size(); ++k)
    points_[k] = lookup.position(orientation.nodes[k], orientation.place);
  if (!orientation.distribution.empty()) points_of_ = by_element(orientation.distribution, 6, lookup);
  if (!orientation.angles.empty()) angle_of_ = by_element(orientation.angles, 1, lookup);
}

AbaqusAxes::ByElement AbaqusAxes::by_element(const std::string& name, std::size_t count, AbaqusLookup& lookup) const {
  ByElement out{find_abaqus(file_.distributions, name), std::vector<int>(file_.draft.cells.size(), -1)};
  if (!out.distribution)
    file_.draft.fail(orientation_.place, "*ORIENTATION: no *DISTRIBUTION {}", TextTokens::quoted(name));
  if (out.distribution->count != count)
    file_.draft.fail(out.distribution->place, "distribution {} does not give {} by element, which orientation {} needs",
                     TextTokens::quoted(out.distribution->name),
                     count == 6 ? "two points (COORD3D, COORD3D)" : "an angle (ANGLE)",
                     TextTokens::quoted(orientation_.name));
  for (std::size_t r = 0; r < out.distribution->rows.size(); ++r)
    lookup.each_cell(out.distribution->rows[r].elements,
                     [&](std::size_t cell) { out.row[cell] = static_cast<int>(r); });
  return out;
}

const std::array<double, 6>& AbaqusAxes::values(const ByElement& listed, std::size_t cell) const {
  const AbaqusDistribution& all = *listed.distribution;
  const int row = listed.row[cell];
  if (row < 0 && all.default_row.empty())
    fail(cell, "its distribution has neither a row for this element nor a default row");
  return row < 0 ? all.default_row.front().values : all.rows[static_cast<std::size_t>(row)].values;
}

void AbaqusAxes::fail(std::size_t cell, const char* what) const {
  file_.draft.fail(orientation_.place, "*ORIENTATION {}, element {}: {}", TextTokens::quoted(orientation_.name),
                   file_.draft.cells[cell].tag, what);
}

Mat3 AbaqusAxes::of(std::size_t cell, const Vec3& centre) const {
  std::array<Vec3, 3> points = points_;
  if (points_of_.distribution) {
    const auto& x = values(points_of_, cell);
    points[0] = orientation_.placement({x[0], x[1], x[2]});
    points[1] = orientation_.placement({x[3], x[4], x[5]});
  }
  const double degrees = angle_of_.distribution ? values(angle_of_, cell)[0] : orientation_.degrees;
  const Mat3 Q = frame(points, centre, cell);
  if (degrees == 0) return Q;
  return Q * Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::Unit(orientation_.axis)).toRotationMatrix();
}

// Rectangular: axis 1 from c to a, b in the plane of axes 1 and 2. Z rectangular: axis 3 from c to a, b in the plane of
// axes 1 and 3. Cylindrical, about the line a-b: radial, tangential, axial. Spherical, with the centre a and the poles
// on the line a-b: radial, tangential (along parallels), meridional.
Mat3 AbaqusAxes::frame(const std::array<Vec3, 3>& points, const Vec3& centre, std::size_t cell) const {
  using enum AbaqusOrientation::System;
  const auto& [a, b, c] = points;
  const auto across = [&](const Vec3& u, const Vec3& v, const char* what) -> Vec3 {
    const Vec3 w = u.cross(v);
    if (!(w.norm() > 1e-12 * u.norm() * v.norm()) || !w.allFinite()) fail(cell, what);
    return w.normalized();
  };
  constexpr const char* kLine = "the points are on a line; give two different directions";
  constexpr const char* kPole = "its centre is on the polar axis, or the two points of the axis coincide";
  Mat3 Q;
  switch (orientation_.system) {
    case rectangular:
      Q.col(2) = across(a - c, b - c, kLine);
      Q.col(0) = (a - c).normalized();
      Q.col(1) = Q.col(2).cross(Q.col(0)).normalized();
      break;
    case z_rectangular:
      Q.col(1) = across(a - c, b - c, kLine);
      Q.col(2) = (a - c).normalized();
      Q.col(0) = Q.col(1).cross(Q.col(2)).normalized();
      break;
    case cylindrical:
      Q.col(1) = across(b - a, centre - a, kPole);
      Q.col(2) = (b - a).normalized();
      Q.col(0) = Q.col(1).cross(Q.col(2)).normalized();
      break;
    case spherical:
      Q.col(1) = across(b - a, centre - a, kPole);
      Q.col(0) = (centre - a).normalized();
      Q.col(2) = Q.col(0).cross(Q.col(1)).normalized();
      break;
  }
  return Q;
}

}  // namespace orthodyn
