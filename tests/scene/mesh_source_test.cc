// Mesh files and generators in a scene, and materials of mesh files.
#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "lib/material_axes/axes_source.h"
#include "tests/scene/scenes.h"

namespace orthodyn::mesh_source_test {
namespace {

const std::string kTet = R"(*VERTICES
4 3 0 0
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
*ELEMENTS
TET
1 4 0
1 1 2 3 4
)";

class VegaScene : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "vega_scene_test_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);  // tests that run beside each other do not share it
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
    return (folder_ / name).string();
  }
  // A scene on the tet with this end of the .veg file, and further keys.
  std::string scene(const std::string& veg, const std::string& keys, const std::string& more = "") const {
    return "mesh: {type: vega, file: " + file("body.veg", kTet + veg) + more + "}\ntime: {end: 1}\n" + keys;
  }

  std::filesystem::path folder_;
};

const std::string kWood =
    "*MATERIAL wood\nORTHOTROPIC, 400, 3e9, 2e9, 1e9, .1, .2, .06, 1e8, 2e8, 3e8, 0,-1,0, 1,0,0, 0,0,1\n"
    "*REGION\nallElements, wood\n";

// The same numbers typed: nu31 of the file is nu31, R has the axes as columns.
TEST_F(VegaScene, MaterialsOfTheFileAreThoseTypedInAScene) {
  const Scene from_file = read_scene(Config::from_text(scene(kWood, ""), "scene.yaml"));
  const Scene typed =
      read_scene(Config::from_text(scene(kWood,
                                         "materials: {wood: {type: orthotropic, density: 400, young: [3e9, 2e9, 1e9], "
                                         "nu12: 0.1, nu23: 0.2, nu31: 0.06, g12: 1e8, g23: 2e8, g13: 3e8}}\nregions: "
                                         "{all: {material: wood, axes: {first: [0, 1, 0], second: [-1, 0, 0]}}}\n"),
                                   "scene.yaml"));
  const auto C = [](const Scene& s) { return voigt(s.materials.at(0).second->stiffness()); };
  EXPECT_EQ(C(from_file), C(typed));
  EXPECT_EQ(from_file.materials[0].second->density(), 400);
  const auto Q = [](const Scene& s) {
    Warnings notes;
    return s.regions.at(0).second.axes->field({}, notes)(Vec3::Zero(), 0);
  };
  EXPECT_EQ(Q(from_file), Q(typed));
  EXPECT_EQ(build(from_file).model->num_dofs(), 12);
}

TEST_F(VegaScene, TheResolvedSceneSpellsOutTheMaterialsOfTheFile) {
  const Config once = Config::from_text(scene(kWood, ""), "scene.yaml").resolving();
  read_scene(once);
  EXPECT_NE(once.dump().find("wood"), std::string::npos);
  const Config twice = Config::from_text(once.dump(), "scene.yaml").resolving();
  read_scene(twice);
  EXPECT_EQ(once.dump(), twice.dump());
}

TEST_F(VegaScene, UnstableMaterialsOfTheFileAreRefusedLikeTypedOnes) {
  const std::string veg = kWood;
  const std::string message = refusal(scene(replaced(veg, ".2, .06", "1.5, .06"), ""));
  for (const char* part : {"body.veg:12: material of the mesh", "nu23=1.5", "indefinite", "Nearest stable set"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST_F(VegaScene, MissingMaterialsAreAskedForIfTheFileHasNone) {
  EXPECT_NE(refusal(scene("", ""))
                .find("'materials' is missing, and the mesh file has none; give materials and regions (body)"),
            std::string::npos);
  EXPECT_NE(
      refusal(replaced(kValidScene, "materials:\n  soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}\n", ""))
          .find("key 'materials' is missing"),
      std::string::npos);
}

TEST_F(VegaScene, FixedVerticesCanBeClampedByName) {
  const std::string fixed = ", fixed: " + file("body.bou", "1,3\n");
  EXPECT_EQ(build_text(scene(kWood, "clamps: [{nodes: fixed}]\n", fixed)).model->num_dofs(), 6);
  const std::string message = refusal(scene(kWood, "clamps: [{nodes: fixe}]\n", fixed));
  EXPECT_NE(
      message.find("scene.yaml:3:10: clamps.0: the mesh has no node set 'fixe'; did you mean 'fixed'? It has fixed"),
      std::string::npos)
      << message;
}

TEST_F(VegaScene, FileChoosesTheFormatByTheEndingAndScales) {
  const std::string yaml =
      "mesh: {type: file, file: " + file("body.veg", kTet + kWood) + ", scale: 0.001}\ntime: {end: 1}\n";
  EXPECT_EQ(bounding_box(build_text(yaml).model->parts().mesh).max, Vec3::Constant(0.001));
  const std::string message = refusal(replaced(
      replaced(yaml, "body.veg", file("body.stl", "").substr(folder_.string().size() + 1)), ", scale: 0.001", ""));
  EXPECT_NE(message.find("no mesh format has the ending \".stl\""), std::string::npos) << message;
}

const std::string kRound =
    R"(mesh: {type: tube, inner_radius: 0.5, radius: 1, length: 4, cells: [12, 2, 6], axis: [1, 0, 0], order: 1}
materials:
  soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}
clamps:
  - surface: end0
time: {end: 0.1}
)";

TEST(RoundScene, ATubeHasItsSurfacesAndItsMass) {
  const BuiltScene built = build_text(kRound);
  const auto& parts = built.model->parts();
  for (const char* surface : {"end0", "end1", "inner", "outer"})
    EXPECT_TRUE(parts.mesh.surfaces.contains(surface)) << surface;
  const double polygons = 12 * std::sin(M_PI / 6) / 2 * (1 - 0.25);
  EXPECT_NEAR(parts.mass->total(), 1000 * 4 * polygons, 1e-9 * parts.mass->total());
}

TEST(RoundScene, WhatMakesNoMeshIsRefusedWithItsKey) {
  EXPECT_NE(
      refusal(replaced(kRound, "inner_radius: 0.5", "inner_radius: 2")).find("mesh.inner_radius: must be smaller"),
      std::string::npos);
  const std::string cylinder = replaced(replaced(kRound, "type: tube", "type: cylinder"), "inner_radius: 0.5, ", "");
  EXPECT_NE(refusal(replaced(cylinder, "[12, 2", "[10, 2")).find("mesh.cells.0: must be a multiple of 4"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(cylinder, "[1, 0, 0]", "[0, 0, 0]")).find("mesh.axis: is zero"), std::string::npos);
  EXPECT_GT(build_text(cylinder).model->num_dofs(), 0);
}

// Thin tubes, discs and washers have hexahedra, other round bodies tetrahedra.
TEST(RoundScene, FlatCellsAreHexahedraByDefault) {
  const auto has_tetrahedra = [](const std::string& mesh) {
    return build_text("mesh: {" + mesh +
                      "}\nmaterials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}\ntime: {end: 1}\n")
        .model->parts()
        .mesh.has_tets_only();
  };
  for (const char* flat : {"type: cylinder, radius: 0.2, length: 0.004, cells: [16, 2, 1]",
                           "type: tube, radius: 0.2, inner_radius: 0.04, length: 0.004, cells: [16, 4, 1]",
                           "type: tube, radius: 0.2, inner_radius: 0.198, length: 0.5, cells: [16, 1, 8]"})
    EXPECT_FALSE(has_tetrahedra(flat)) << flat;
  for (const char* other : {"type: cylinder, radius: 0.2, length: 4, cells: [16, 2, 10]",
                            "type: cylinder, radius: 0.2, length: 0.4, cells: [16, 2, 8]",
                            "type: tube, radius: 0.2, inner_radius: 0.1, length: 2, cells: [16, 2, 10]",
                            "type: cylinder, radius: 0.2, length: 0.004, cells: [16, 2, 1], order: 1",
                            "type: cylinder, radius: 0.2, length: 0.004, cells: [16, 2, 1], elements: tetrahedra"})
    EXPECT_TRUE(has_tetrahedra(other)) << other;
}

TEST(MeshFile, OfHexahedraMayGetNodesInTheirCentres) {
  const auto scene = [](const std::string& more) {
    return fmt::format(
        "mesh: {{type: file, file: {}/tests/mesh/data/tube_hexahedra_41.msh{}}}\n"
        "materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}\nregions: {{all: {{material: m}}}}\n"
        "time: {{end: 1}}\n",
        ORTHODYN_SOURCE_DIR, more);
  };
  EXPECT_EQ(build_text(scene(", order: 2, centres: true")).model->parts().mesh.cells.shape(0), CellShape::hex27);
  EXPECT_EQ(build_text(scene(", order: 2")).model->parts().mesh.cells.shape(0), CellShape::hex20);
  EXPECT_NE(refusal(scene(", order: 2, split: true, centres: true")).find("tetrahedra only"), std::string::npos);
  EXPECT_NE(refusal(scene(", order: 1, centres: true")).find("the elements are linear"), std::string::npos);
}

}  // namespace
}  // namespace orthodyn::mesh_source_test
