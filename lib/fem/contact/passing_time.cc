#include "lib/fem/contact/passing_time.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace orthodyn {

namespace {

double passing_time_of_nodes(const ContactSurface& own, const ContactSurface& other, double depth, const NodalVector& x,
                             const NodalVector& v) {
  constexpr double kSafety = 0.4;  // the mean velocity of a step may be 2.5 times that at its start
  Eigen::AlignedBox3d box;
  Vec3 mean = Vec3::Zero();
  for (const auto& [node, area] : other.areas()) {
    box.extend(Vec3(x.col(node)));
    mean += v.col(node) / static_cast<double>(other.areas().size());
  }
  double spread = 0;
  for (const auto& [node, area] : other.areas()) spread = std::max(spread, (v.col(node) - mean).norm());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [node, area] : own.areas()) {
    const double speed = (v.col(node) - mean).norm() + spread;
    if (speed > 0) least = std::min(least, (box.exteriorDistance(Vec3(x.col(node))) + depth) / speed);
  }
  return kSafety * least;
}

}  // namespace

double passing_time(const ContactSurface& first, const ContactSurface& second, double depth, const NodalVector& x,
                    const NodalVector& v) {
  const double time = passing_time_of_nodes(first, second, depth, x, v);
  return &first == &second ? time : std::min(time, passing_time_of_nodes(second, first, depth, x, v));
}

}  // namespace orthodyn
