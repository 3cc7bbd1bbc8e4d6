#include "lib/material_axes/given_axes.h"

#include <cmath>
#include <numbers>

namespace orthodyn {

namespace {

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

Mat3 unit_columns(const Mat3& columns) {
  Mat3 unit;
  for (int i = 0; i < 3; ++i) unit.col(i) = columns.col(i).stableNormalized();
  return unit;
}

bool left_handed(const Mat3& columns) { return unit_columns(columns).determinant() < 0; }

}  // namespace

bool span_space(const Mat3& columns) { return std::abs(unit_columns(columns).determinant()) > 1e-3; }

std::string defect_of_axes(const Mat3& columns) {
  std::vector<std::string> found;
  for (int i = 0; i < 3; ++i)
    if (const double length = columns.col(i).stableNorm(); !(std::abs(length - 1) <= kAxesTolerance))
      found.push_back(fmt::format("axis {} has length {:.6g}", i + 1, length));
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 3; ++j) {
      const double angle = degrees_between(columns.col(i).stableNormalized(), columns.col(j).stableNormalized());
      if (!(std::abs(angle - 90) <= kAxesTolerance * 180 / std::numbers::pi))
        found.push_back(fmt::format("axes {} and {} enclose {:.6g} degrees", i + 1, j + 1, angle));
    }
  if (left_handed(columns)) found.emplace_back("axis 3 points against 1 x 2 (left-handed)");
  return join(found, "; ");
}

Mat3 nearest_axes(const Mat3& columns) {
  Mat3 unit = unit_columns(columns);
  if (left_handed(columns)) unit.col(2) *= -1;
  const Eigen::JacobiSVD<Mat3> svd(unit, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

void check_axes(const Mat3& columns, AxesRepair repair, const Refuse& refuse) {
  const std::string defect = defect_of_axes(columns);
  if (!span_space(columns)) refuse("the three directions lie (nearly) in one plane or are zero: " + defect);
  else if (!defect.empty() && repair == AxesRepair::refuse)
    refuse(defect + "; correct them, or replace them by the nearest axes with 'repair: orthonormalise'");
}

std::string repair_note(const Mat3& columns) {
  const std::string defect = defect_of_axes(columns);
  if (defect.empty()) return "";
  const Mat3 Q = nearest_axes(columns);
  double turned = 0;
  for (int i = 0; i < 3; ++i) {
    const double angle = degrees_between(columns.col(i).stableNormalized(), Q.col(i));
    turned = std::max(turned, std::min(angle, 180 - angle));
  }
  return fmt::format("{}; repaired: lengths set to 1, directions rotated by at most {:.3g} degrees{}", defect, turned,
                     left_handed(columns) ? ", axis 3 reversed" : "");
}

}  // namespace orthodyn
