#include "lib/mesh/io/abaqus_transform.h"

#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace orthodyn {
namespace {

// Points a and b: axis 1 goes from the origin through a, b is in the plane of axes 1 and 2, on the side of axis 2.
std::optional<std::array<Vec3, 2>> transform_points(AbaqusLines& lines) {
  std::array<Vec3, 2> points{Vec3::Zero(), Vec3::Zero()};
  if (lines.at_keyword()) return std::nullopt;
  const auto& fields = lines.data();
  if (fields.size() > 6) return std::nullopt;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::optional<double> number = abaqus_number(fields[k]);
    if (!number) return std::nullopt;
    points[k / 3][static_cast<Eigen::Index>(k % 3)] = *number;
  }
  return points;
}

bool turns_nothing(const Vec3& a, const Vec3& b, const Mat3& R) {
  const Vec3 normal = a.cross(b);
  if (!(normal.norm() > 0)) return false;
  Mat3 Q;
  Q.col(0) = a.normalized();
  Q.col(2) = normal.normalized();
  Q.col(1) = Q.col(2).cross(Q.col(0));
  return (R * Q - Mat3::Identity()).norm() < 1e-6;
}

}  // namespace

AbaqusTransform read_abaqus_transform(const AbaqusKeyword& keyword, const std::string& set, const Mat3& R,
                                      AbaqusLines& lines) {
  AbaqusTransform out{.set = set, .place = keyword.place};
  const std::string type = abaqus_word(keyword.parameter("TYPE"));
  const bool is_rectangular = type.empty() || type[0] == 'R';
  const auto points = transform_points(lines);
  lines.skip_data();
  out.is_identity = is_rectangular && points && turns_nothing((*points)[0], (*points)[1], R);
  return out;
}

}  // namespace orthodyn
