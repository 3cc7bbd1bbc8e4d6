#include "lib/mesh/near_nodes.h"

#include <algorithm>
#include <numeric>

namespace orthodyn {

NearNodes::NearNodes(const Mesh& mesh) : mesh_(mesh), by_x_(mesh.nodes.size()) {
  std::iota(by_x_.begin(), by_x_.end(), 0);
  std::stable_sort(by_x_.begin(), by_x_.end(), [&](int a, int b) {
    return mesh.nodes[static_cast<std::size_t>(a)][0] < mesh.nodes[static_cast<std::size_t>(b)][0];
  });
}

std::optional<int> NearNodes::within(double distance, const Vec3& point) const {
  const auto place = [&](int node) -> const Vec3& { return mesh_.nodes[static_cast<std::size_t>(node)]; };
  const auto left_of = [&](int node, double x) { return place(node)[0] < x; };
  std::optional<int> nearest;
  auto it = std::lower_bound(by_x_.begin(), by_x_.end(), point[0] - distance, left_of);
  for (; it != by_x_.end() && place(*it)[0] <= point[0] + distance; ++it)
    if (const double d = (place(*it) - point).norm(); d <= distance) {
      distance = d;
      nearest = *it;
    }
  return nearest;
}

}  // namespace orthodyn
