#include "lib/fem/rigid_body.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"
#include "lib/fem/element_mesh.h"

namespace orthodyn {

namespace {

constexpr double kOnLine = 1e-9;  // of distances from a line or plane, relative to the body

// Distance of x from the point, line or plane through the given points.
double distance_from(const std::vector<Vec3>& through, const Vec3& x) {
  const Vec3 r = x - through[0];
  if (through.size() == 1) return r.norm();
  const Vec3 a = through[1] - through[0];
  if (through.size() == 2) return r.cross(a).norm() / a.norm();
  const Vec3 normal = a.cross(Vec3(through[2] - through[0])).normalized();
  return std::abs(r.dot(normal));
}

using Weights = std::vector<std::pair<int, double>>;

// Barycentric coordinates in the tetrahedron of a frame at rest.
class Barycentric {
 public:
  Barycentric(const Mesh& mesh, const std::array<int, 4>& frame) : frame_(frame), origin_(mesh.node(frame[0])) {
    Mat3 edges;
    for (std::size_t k = 1; k < 4; ++k) edges.col(static_cast<Eigen::Index>(k) - 1) = mesh.node(frame[k]) - origin_;
    inverse_ = edges.inverse();
  }

  Weights of(const Vec3& point) const {
    const Vec3 w = inverse_ * (point - origin_);
    return {{frame_[0], 1 - w.sum()}, {frame_[1], w[0]}, {frame_[2], w[1]}, {frame_[3], w[2]}};
  }

  // The derivatives of the four weights by the place, 1/m.
  Eigen::Matrix<double, 4, 3> gradients() const {
    Eigen::Matrix<double, 4, 3> out;
    out << -inverse_.colwise().sum(), inverse_;
    return out;
  }

 private:
  std::array<int, 4> frame_;
  Vec3 origin_;
  Mat3 inverse_;
};

// The nodes of a frame: the first is far from the mean of all nodes, and each further one as far as possible from the
// point, line or plane through those before. Returns fewer than four if the nodes lie in a plane or on a line. Of nodes
// that are almost equally far from the plane, the fourth is the one nearest to the third. So three nodes of a thin
// rod's frame lie at one end, and two of a plate's frame above each other: the distances do not depend on each other.
// Of equally far nodes, such as the corners of a box, the first one is taken, whatever the round-off.
std::vector<int> frame_of(const Mesh& mesh, const std::vector<int>& nodes) {
  constexpr double kAlmost = 0.9;
  Vec3 mean = Vec3::Zero();
  for (const int node : nodes) mean += mesh.node(node) / static_cast<double>(nodes.size());
  std::vector<int> frame;
  std::vector<Vec3> through{mean};
  double size = 0;
  for (int k = 0; k < 4; ++k) {
    double farthest = -1;
    int best = -1;
    for (const int node : nodes)
      if (const double distance = distance_from(through, mesh.node(node)); distance > (1 + kOnLine) * farthest) {
        farthest = distance;
        best = node;
      }
    size = std::max(size, farthest);
    if (farthest <= kOnLine * size) return frame;
    const auto from_third = [&](int node) { return (mesh.node(node) - through.back()).norm(); };
    for (const int node : nodes)
      if (k == 3 && from_third(node) < (1 - kOnLine) * from_third(best) &&
          distance_from(through, mesh.node(node)) >= kAlmost * farthest)
        best = node;
    frame.push_back(best);
    if (k == 0) through.clear();
    through.push_back(mesh.node(best));
  }
  return frame;
}

// J = trace(E) I - E for Euler's tensor E.
Mat3 moments_of(const Mat3& euler) { return euler.trace() * Mat3::Identity() - euler; }

// The consistent mass M integrates rho N_a N_b, so that Euler's tensor is the sum of M_ab r_a r_b^T.
RigidInertia inertia_of(const ElementMesh& mesh, std::size_t cell, double density) {
  const ElementType::Nodes X = mesh.positions(cell);
  const Eigen::MatrixXd M = mesh.type(cell).consistent_mass(X, density);
  RigidInertia out{M.sum(), Vec3(X * M.rowwise().sum()) / M.sum()};
  const ElementType::Nodes r = X.colwise() - out.center;
  out.moments = moments_of(Mat3(r * M * r.transpose()));
  return out;
}

}  // namespace

Vec3 RigidInertia::principal_moments() const {
  return Eigen::SelfAdjointEigenSolver<Mat3>(moments, Eigen::EigenvaluesOnly).eigenvalues();
}

void RigidInertia::add(const RigidInertia& other) {
  const double sum = mass + other.mass;
  if (sum == 0) return;
  const Vec3 apart = other.center - center;
  moments += other.moments + moments_of(mass * other.mass / sum * apart * apart.transpose());
  center += other.mass / sum * apart;
  mass = sum;
}

RigidBody rigid_body(const Mesh& mesh, const std::vector<int>& nodes, std::string name, std::string place) {
  const std::vector<int> frame = frame_of(mesh, nodes);
  if (frame.size() < 4)
    throw ConfigError(place, fmt::format("the nodes of the rigid region '{}' lie in a plane", name));
  RigidBody body{std::move(name), std::move(place), {frame[0], frame[1], frame[2], frame[3]}, {}};
  const Barycentric barycentric(mesh, body.frame);
  for (const int node : nodes)
    if (std::find(frame.begin(), frame.end(), node) == frame.end())
      body.followers.push_back({node, barycentric.of(mesh.node(node))});
  return body;
}

std::vector<int> RigidBody::nodes() const {
  std::vector<int> all(frame.begin(), frame.end());
  for (const TiedNode& follower : followers) all.push_back(follower.node);
  return all;
}

bool RigidBody::contains(const std::vector<int>& some) const {
  std::vector<int> all = nodes();
  std::sort(all.begin(), all.end());
  return std::all_of(some.begin(), some.end(),
                     [&](int node) { return std::binary_search(all.begin(), all.end(), node); });
}

JointPoint RigidBody::point(const Mesh& mesh, const Vec3& point) const {
  return {Barycentric(mesh, frame).of(point), point};
}

FrameMass RigidBody::frame_mass(const Mesh& mesh) const {
  const Barycentric barycentric(mesh, frame);
  const Eigen::Matrix<double, 4, 3> gradients = barycentric.gradients();
  FrameMass out{frame, Eigen::Matrix4d::Zero(), nodes()};
  for (const RigidInertia& own : given) {
    Eigen::Vector4d at_center;
    const auto weights = barycentric.of(own.center);
    for (std::size_t a = 0; a < 4; ++a) at_center[static_cast<Eigen::Index>(a)] = weights[a].second;
    out.matrix += own.mass * at_center * at_center.transpose() + gradients * own.euler() * gradients.transpose();
  }
  return out;
}

Joint RigidBody::rigidity(const Mesh& mesh) const {
  const auto corner = [&](std::size_t k) { return JointPoint{{{frame[k], 1.0}}, mesh.node(frame[k])}; };
  Joint joint{name, place, {}, Joint::Of::rigid_body};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b) joint.equations.push_back(JointEquation::distance(corner(a), corner(b)));
  return joint;
}

void add_inertia(const Mesh& mesh, const std::vector<double>& density, std::vector<RigidBody>& bodies) {
  if (bodies.empty()) return;
  std::vector<RigidBody*> body_of(mesh.nodes.size(), nullptr);
  for (RigidBody& body : bodies) {
    for (const int node : body.nodes()) body_of[static_cast<std::size_t>(node)] = &body;
    for (const RigidInertia& given : body.given) body.inertia.add(given);
  }
  const ElementMesh elements(mesh);
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto of = [&](int node) { return body_of[static_cast<std::size_t>(node)]; };
    const auto nodes = mesh.cells[cell];
    RigidBody* const body = of(nodes[0]);
    if (body && density[cell] > 0 && std::all_of(nodes.begin(), nodes.end(), [&](int n) { return of(n) == body; }))
      body->inertia.add(inertia_of(elements, cell, density[cell]));
  }
}

bool spans_plane(const Mesh& mesh, const std::vector<int>& nodes) {
  return !nodes.empty() && frame_of(mesh, nodes).size() >= 3;
}

}  // namespace orthodyn
