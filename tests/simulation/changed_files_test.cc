// A run does not resume if its input files have changed.
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::changed_files_test {
namespace {

TEST_F(Resume, AMeshFileThatHasChangedIsRefused) {
  const auto mesh = [&](const char* height) {
    write("tet.msh", std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 ") +
                         height + "\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
  };
  mesh("1");
  write("tet.yaml",
        "mesh: {type: gmsh, file: tet.msh}\nmaterials: {m: {type: isotropic, density: 1, young: 1e3, nu: 0.3}}\n"
        "initial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\ncheckpoint: {every: 1}\n");
  const auto first = orthodyn("run tet.yaml --quiet");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  mesh("1.1");
  const auto result = orthodyn("run tet.yaml --quiet --resume --set time.end=0.2");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("tet.msh: has changed"), std::string::npos) << result.output;
}

// Two tetrahedra; `regions` are the attributes of the two.
class TetgenMesh : public Resume {
 protected:
  TetgenMesh() {
    write("two.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n");
    write_elements("1", "2");
    write("two.yaml",
          "mesh: {type: file, file: two.node}\nmaterials: {m: {type: isotropic, density: 1, young: 1e3, nu: 0.3}}\n"
          "initial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\ncheckpoint: {every: 1}\n");
  }
  void write_elements(const std::string& first, const std::string& second) const {
    write("two.ele", "2 4 1\n1 1 2 3 4 " + first + "\n2 1 3 2 5 " + second + "\n");
  }
};

TEST_F(TetgenMesh, ElementsThatChangedTheirRegionsAreRefused) {
  const auto first = orthodyn("run two.yaml --quiet");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  write_elements("2", "1");
  const auto result = orthodyn("run two.yaml --quiet --resume --set time.end=0.2");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("the mesh has changed"), std::string::npos) << result.output;
}

TEST_F(TetgenMesh, AFileOfTheInputThatHasChangedIsRefusedByItsName) {
  const auto axes = [&](const char* first) {
    write("axes.csv", "a1x,a1y,a1z,a2x,a2y,a2z\n" + std::string(first) + "\n1,0,0,0,1,0\n");
  };
  axes("1,0,0,0,1,0");
  write("grain.yaml",
        "mesh: {type: file, file: two.node}\nmaterials: {m: {type: orthotropic_stable, density: 1, young: [3e3, 2e3, "
        "1e3], nu: 0.3}}\nregions: {all: {material: m, axes: {type: file, file: axes.csv}}}\n"
        "initial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\ncheckpoint: {every: 1}\n");
  const auto first = orthodyn("run grain.yaml --quiet");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  const auto same = orthodyn("run out/grain --quiet --resume --set time.end=0.2");  // named from another folder
  ASSERT_EQ(same.exit_code, 0) << same.output;
  axes("0,1,0,1,0,0");
  const auto result = orthodyn("run grain.yaml --quiet --resume --set time.end=0.3");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("axes.csv"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::changed_files_test
