// Regions of linear elements with too few elements through the thickness.
#include "lib/simulation/preflight/thickness_check.h"

#include <gtest/gtest.h>

#include "lib/simulation/run/setup.h"

namespace orthodyn::thickness_check_test {
namespace {

std::vector<std::string> of_box(const std::string& cells, int order) {
  const Config config = Config::from_text("mesh: {type: box, size: [1, 0.2, 0.2], cells: " + cells +
                                          ", order: " + std::to_string(order) + R"(}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
clamps: [{surface: x0}]
time: {end: 1}
)");
  return thin_regions(build(read_scene(config)).model->parts());
}

TEST(ThinRegions, AreOneToThreeLinearElementsThick) {
  ASSERT_EQ(of_box("[8, 1, 4]", 1).size(), 1u);
  EXPECT_NE(of_box("[8, 1, 4]", 1)[0].find("region body is one linear element"), std::string::npos);
  ASSERT_EQ(of_box("[8, 2, 4]", 1).size(), 1u);
  EXPECT_NE(of_box("[8, 3, 6]", 1)[0].find("two or three"), std::string::npos);
  EXPECT_TRUE(of_box("[8, 4, 4]", 1).empty());
}

TEST(ThinRegions, AreNoneOfQuadraticElements) { EXPECT_TRUE(of_box("[8, 1, 1]", 2).empty()); }

TEST(ThinRegions, AreNotRigid) {
  const Config config = Config::from_text(R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [8, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
regions: {body: {material: soft, rigid: true}}
time: {end: 1}
)");
  EXPECT_TRUE(thin_regions(build(read_scene(config)).model->parts()).empty());
}

}  // namespace
}  // namespace orthodyn::thickness_check_test
