#include "lib/fem/joint_point.h"

#include <Eigen/QR>
#include <algorithm>

namespace orthodyn {

JointPoint joint_point(const Mesh& mesh, const std::vector<int>& nodes, const Vec3& point) {
  constexpr double kRoundOff = 1e-9;
  double size = 0;
  for (const int node : nodes) size = std::max(size, (mesh.node(node) - point).norm());
  if (size == 0) size = 1;
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::Matrix4Xd A(4, n);  // of the sum and the place, relative to the point and to the size
  for (Eigen::Index i = 0; i < n; ++i) A.col(i) << 1, (mesh.node(nodes[static_cast<std::size_t>(i)]) - point) / size;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_norm;
  least_norm.setThreshold(kRoundOff);
  least_norm.compute(A);
  const Eigen::Vector4d wanted = Eigen::Vector4d::UnitX();
  const Vector weights = least_norm.solve(wanted);
  JointPoint out{{}, point};
  if ((A * weights - wanted).norm() > kRoundOff) return out;
  for (Eigen::Index i = 0; i < n; ++i) out.weights.emplace_back(nodes[static_cast<std::size_t>(i)], weights[i]);
  return out;
}

}  // namespace orthodyn
