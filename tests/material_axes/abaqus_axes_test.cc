// The orientations of an Abaqus file as axes of a scene.
#include <filesystem>
#include <fstream>

#include "lib/scene/build.h"
#include "tests/material_axes/axes_of.h"

namespace orthodyn::abaqus_axes_test {
namespace {

constexpr const char* kDeck = R"(*Node
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 1, 1, 1
*Element, type=C3D4, elset=core
1, 1, 2, 3, 4
*Element, type=C3D4, elset=shell
2, 2, 3, 4, 5
*Orientation, name=along_y
0, 1, 0, 0, 0, 1
*Solid section, elset=core
*Solid section, elset=shell, orientation=along_y
)";

class AbaqusAxes : public testing::Test {
 protected:
  AbaqusAxes() { std::ofstream(path_) << kDeck; }
  ~AbaqusAxes() override { std::filesystem::remove(path_); }

  BuiltScene built(const std::string& axes, const std::string& material) const {
    const std::string scene = "mesh: {type: file, file: " + path_ + "}\nmaterials: {m: {" + material +
                              "}}\nregions: {all: {material: m" + axes + "}}\ntime: {end: 1}\n";
    return build(read_scene(Config::from_text(scene, "scene.yaml")));
  }
  static bool warns(const BuiltScene& built) {
    for (const auto& warning : built.warnings)
      if (warning.find("which the scene does not use") != std::string::npos) return true;
    return false;
  }

  const std::string path_ = (std::filesystem::path(testing::TempDir()) /
                             (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".inp"))
                                .string();
  const std::string wood_ = "type: orthotropic_stable, density: 450, young: [10 GPa, 1 GPa, 1 GPa], nu: 0.3";
};

TEST_F(AbaqusAxes, AreThoseOfTheSections) {
  const BuiltScene scene = built(", axes: {type: file, file: " + path_ + "}", wood_);
  const auto& regions = scene.model->parts().elastic;
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_LE((regions[0]->axes_at_rest(0, 0) - Mat3::Identity()).norm(), 1e-15);
  Mat3 expected;
  expected << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_LE((regions[1]->axes_at_rest(0, 0) - expected).norm(), 1e-15);
  EXPECT_FALSE(warns(scene));
}

TEST_F(AbaqusAxes, AreMissedWhereTheMaterialHasDirections) {
  EXPECT_TRUE(warns(built("", wood_)));
  EXPECT_FALSE(warns(built("", "type: isotropic, density: 450, young: 1 GPa, nu: 0.3")));
}

}  // namespace
}  // namespace orthodyn::abaqus_axes_test
