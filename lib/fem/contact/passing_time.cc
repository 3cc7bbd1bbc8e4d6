#include "lib/fem/contact/passing_time.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace orthodyn {

namespace {

// The rigid motion that fits the velocities of nodes best.
class CommonMotion {
 public:
  CommonMotion(const std::vector<int>& nodes, const NodalVector& x, const NodalVector& v) {
    for (const int node : nodes) {
      centre_ += x.col(node) / static_cast<double>(nodes.size());
      velocity_ += v.col(node) / static_cast<double>(nodes.size());
    }
    Mat3 inertia = Mat3::Zero();
    Vec3 momentum = Vec3::Zero();
    for (const int node : nodes) {
      const Vec3 r = x.col(node) - centre_;
      inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
      momentum += r.cross(Vec3(v.col(node) - velocity_));
    }
    rate_ = inertia.completeOrthogonalDecomposition().solve(momentum);
  }
  Vec3 at(const Vec3& x) const { return velocity_ + rate_.cross(x - centre_); }

 private:
  Vec3 centre_ = Vec3::Zero(), velocity_ = Vec3::Zero(), rate_ = Vec3::Zero();  // m, m/s, rad/s
};

}  // namespace

// Two nodes are at least as far apart as each of them is from the box around the other surface. So they pass after the
// shorter one of the times in which either goes half of this way, in a frame that moves with both bodies.
double passing_time(const ContactSurface& first, const ContactSurface& second, double depth, const NodalVector& x,
                    const NodalVector& v) {
  constexpr double kSafety = 0.4;  // the mean velocity of a step may be 2.5 times that at its start
  std::vector<int> nodes;
  for (const ContactSurface* surface : {&first, &second})
    for (const auto& [node, area] : surface->areas()) nodes.push_back(node);
  const CommonMotion together(nodes, x, v);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [own, other] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    const Eigen::AlignedBox3d box = other->box(x);
    for (const auto& [node, area] : own->areas()) {
      const double speed = (v.col(node) - together.at(x.col(node))).norm();
      if (speed > 0) least = std::min(least, (box.exteriorDistance(Vec3(x.col(node))) + depth) / (2 * speed));
    }
  }
  return kSafety * least;
}

}  // namespace orthodyn
