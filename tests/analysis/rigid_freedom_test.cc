// Free rigid motions of a block that is clamped at a few of its corners.
#include "lib/analysis/rigid_freedom.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scene/scenes.h"

namespace orthodyn::rigid_freedom_test {
namespace {

const Vec3 kSizes[] = {{1, 1, 1}, {2, 1.3, 0.7}, {1, 0.1, 3.3}, {0.011, 0.023, 0.0057}, {1.7, 0.9, 0.31}};

// A block clamped at corners; each corner is given by the coordinates that lie on the far side.
int freedom(const Vec3& size, const std::vector<Vec3>& corners) {
  std::string clamps;
  for (const Vec3& corner : corners)
    clamps += fmt::format("  - {{nearest: {}}}\n", Value<Vec3>::yaml(corner.cwiseProduct(size)));
  return count_rigid_freedom(*build_text(fmt::format(R"(mesh: {{type: box, size: {}, cells: [3, 2, 2], order: 1}}
materials: {{soft: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}
clamps:
{}time: {{end: 0.1}}
)",
                                                     Value<Vec3>::yaml(size), clamps))
                                  .model,
                             0);
}

TEST(RigidFreedom, OfABlockClampedAtTheEndsOfADiagonalIsItsTurnAboutThat) {
  for (const Vec3& size : kSizes) {
    EXPECT_EQ(freedom(size, {{0, 0, 0}, {1, 1, 1}}), 1) << size.transpose();
    EXPECT_EQ(freedom(size, {{1, 0, 0}, {0, 1, 1}}), 1) << size.transpose();
    EXPECT_EQ(freedom(size, {{0, 1, 0}, {1, 0, 1}}), 1) << size.transpose();
    EXPECT_EQ(freedom(size, {{0, 0, 1}, {1, 1, 0}}), 1) << size.transpose();
    EXPECT_EQ(freedom(size, {{0, 0, 0}, {1, 1, 0}}), 1) << size.transpose();
  }
}

TEST(RigidFreedom, IsThreeTurnsAboutOneCornerAndNoneOfThree) {
  for (const Vec3& size : kSizes) {
    EXPECT_EQ(freedom(size, {{0, 0, 0}}), 3) << size.transpose();
    EXPECT_EQ(freedom(size, {{0, 0, 0}, {1, 1, 1}, {1, 0, 0}}), 0) << size.transpose();
  }
}

}  // namespace
}  // namespace orthodyn::rigid_freedom_test
