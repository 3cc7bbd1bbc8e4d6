#include "lib/fem/surface.h"

#include <algorithm>
#include <map>

#include "lib/fem/face_nodes.h"

namespace orthodyn {

namespace {

// Sums nodal values over faces. of_face<F>(X) returns a function of a that gives the value at node a of the face.
template <class Value, class OfFace>
std::vector<std::pair<int, Value>> sum_over_faces(const Mesh& mesh, const std::vector<FaceCorners>& faces,
                                                  const Value& zero, const OfFace& of_face) {
  std::map<int, Value> sums;
  for_each_face(mesh, faces, [&]<Face F>(std::span<const int> nodes, const FaceNodes<F>& X) {
    const auto values = of_face.template operator()<F>(X);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      sums.try_emplace(nodes[a], zero).first->second += values(static_cast<Eigen::Index>(a));
  });
  return {sums.begin(), sums.end()};
}

template <class Traction>
NodalForces forces_of(const Mesh& mesh, const std::vector<FaceCorners>& faces, const Traction& traction) {
  return sum_over_faces<Vec3>(mesh, faces, Vec3::Zero(), [&]<Face F>(const FaceNodes<F>& X) {
    return [all = node_integrals<F>(X, traction)](Eigen::Index a) { return Vec3(all.col(a)); };
  });
}

}  // namespace

double surface_area(const Mesh& mesh, const std::vector<FaceCorners>& faces) {
  double sum = 0;
  for_each_face(mesh, faces, [&]<Face F>(std::span<const int>, const FaceNodes<F>& X) { sum += area<F>(X); });
  return sum;
}

NodalForces surface_forces(const Mesh& mesh, const std::vector<FaceCorners>& faces, const Vec3& traction) {
  return forces_of(mesh, faces, [&](const Vec3&) { return traction; });
}

NodalForces surface_forces(const Mesh& mesh, const std::vector<FaceCorners>& faces,
                           const std::array<PointQuantity, 3>& traction) {
  return forces_of(mesh, faces,
                   [&](const Vec3& x) { return Vec3(traction[0].at(x), traction[1].at(x), traction[2].at(x)); });
}

double largest_area(const std::vector<std::pair<int, double>>& areas) {
  double largest = 0;
  for (const auto& [node, area] : areas) largest = std::max(largest, area);
  return largest;
}

}  // namespace orthodyn
