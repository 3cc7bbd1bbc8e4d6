#include "lib/fem/contact/passing_time.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <unsupported/Eigen/BVH>

namespace orthodyn {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// The velocities of the nodes of two surfaces beside their common motion; those of other nodes are 0.
NodalVector beside_common_motion(const ContactSurface& first, const ContactSurface& second, const NodalVector& x,
                                 const NodalVector& v) {
  std::vector<int> nodes;
  for (const ContactSurface* surface : {&first, &second})
    for (const auto& [node, area] : surface->areas()) nodes.push_back(node);
  const CommonMotion common(nodes, x, v);
  NodalVector w = NodalVector::Zero(3, v.cols());
  for (const int node : nodes) w.col(node) = v.col(node) - common.at(x.col(node));
  return w;
}

// A box in space (m), with the range of speeds of its triangles (m/s) as a fourth dimension.
using Box = Eigen::AlignedBox<double, 4>;
using Tree = Eigen::KdBVH<double, 4, int>;

double distance(const Box& a, const Box& b) {
  const Eigen::Vector4d between = (a.min() - b.max()).cwiseMax(b.min() - a.max()).cwiseMax(0);
  return between.head<3>().norm();
}

// The triangles of a surface, with the velocities w of its nodes beside a common motion.
struct MovingTriangles {
  MovingTriangles(const ContactSurface& surface, const NodalVector& x, const NodalVector& w)
      : nodes(surface.triangles()) {
    std::vector<int> numbers(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      numbers[k] = static_cast<int>(k);
      double speed = 0;
      for (const int node : nodes[k]) speed = std::max(speed, w.col(node).norm());
      Box box;
      for (const int node : nodes[k]) box.extend((Eigen::Vector4d() << x.col(node), speed).finished());
      boxes.push_back(box);
    }
    tree.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
  }

  const std::vector<ContactSurface::Corners>& nodes;
  std::vector<Box> boxes;
  Tree tree;
};

// The time in which triangles of two surfaces can be `depth` behind each other, for Eigen's BVMinimize(): the distance
// of their boxes over the largest relative velocity of their corners. For boxes of many triangles, a lower bound.
struct PassingTime {
  using Scalar = double;

  double minimumOnVolumeVolume(const Box& a, const Box& b) const {
    return (distance(a, b) + depth) / (a.max()[3] + b.max()[3]);
  }
  double minimumOnVolumeObject(const Box& a, int b) const {
    return minimumOnVolumeVolume(a, second.boxes[static_cast<std::size_t>(b)]);
  }
  double minimumOnObjectVolume(int a, const Box& b) const {
    return minimumOnVolumeVolume(first.boxes[static_cast<std::size_t>(a)], b);
  }
  double minimumOnObjectObject(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    double speed = 0;
    for (const int m : first.nodes[i])
      for (const int n : second.nodes[j]) {
        if (m == n) return kInfinity;
        speed = std::max(speed, (w.col(m) - w.col(n)).norm());
      }
    return (distance(first.boxes[i], second.boxes[j]) + depth) / speed;
  }

  const MovingTriangles &first, &second;
  const NodalVector& w;  // m/s
  double depth;
};

}  // namespace

double passing_time(const ContactSurface& first, const ContactSurface& second, double depth, const NodalVector& x,
                    const NodalVector& v) {
  constexpr double kSafety = 0.4;  // the mean velocity of a step may be 2.5 times that at its start
  const NodalVector w = beside_common_motion(first, second, x, v);
  const MovingTriangles a(first, x, w), b(second, x, w);
  PassingTime time{a, b, w, depth};
  const double least = Eigen::BVMinimize(a.tree, b.tree, time);
  return least < std::numeric_limits<double>::max() ? kSafety * least : kInfinity;
}

}  // namespace orthodyn
