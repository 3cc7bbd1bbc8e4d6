// Nearest nodes, compared with a search of all nodes.
#include "lib/mesh/near_nodes.h"

#include <gtest/gtest.h>

#include "lib/mesh/box.h"
#include "lib/mesh/selection.h"
#include "tests/material/constants.h"

namespace orthodyn::near_nodes_test {
namespace {

TEST(NearNodes, FindTheNearestWithinTheDistanceOrNone) {
  const Mesh mesh = make_box({.size = {1, 2, 3}, .cells = {3, 4, 5}});
  const NearNodes near(mesh);
  Random random(401);
  int found = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 point(random.between(-0.3, 1.3), random.between(-0.3, 2.3), random.between(-0.3, 3.3));
    const int nearest = nearest_node(mesh, point);
    const double distance = (mesh.nodes[static_cast<std::size_t>(nearest)] - point).norm();
    const auto node = near.within(0.3, point);
    EXPECT_EQ(node.has_value(), distance <= 0.3);
    EXPECT_EQ(node.value_or(nearest), nearest);
    found += node.has_value();
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 450);
}

TEST(NearNodes, FindANodeAtItsVeryPlace) {
  const Mesh mesh = make_box({.cells = {2, 2, 2}});
  const NearNodes near(mesh);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) EXPECT_EQ(near.within(0, mesh.nodes[i]), static_cast<int>(i));
}

}  // namespace
}  // namespace orthodyn::near_nodes_test
