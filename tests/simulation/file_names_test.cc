// File names that the system cannot look up are input errors, wherever they are given.
#include "tests/simulation/run_program.h"

namespace orthodyn::file_names_test {
namespace {

class FileNames : public InFolder {
 protected:
  FileNames() {
    write("swing.yaml", kSwing);
    fs::create_symlink("circle", folder_ / "circle");
  }

  // Name too long, path too long, path through a file, circular links, missing file.
  static std::vector<std::string> names() {
    return {std::string(300, 'a'), std::string(100'000, 'a'), "swing.yaml/a", "circle", "circle/a", "nowhere"};
  }
};

TEST_F(FileNames, OfAScene) {
  for (const std::string& name : names())
    for (const std::string& section :
         {"mesh: {type: gmsh, file: " + name + ".msh}", "mesh: {type: file, file: " + name + ".vtu}",
          "regions: {all: {material: soft, axes: {type: file, file: " + name + ".csv}}}",
          "terms: [{type: nodal_forces, file: " + name + ".csv}]",
          "loads: [{surface: x1, force: [0, 0, 1], factor: {type: table, file: " + name + ".csv}}]",
          "include: " + name + ".yaml"}) {
      std::string scene = kSwing;
      if (const auto mesh = scene.find("mesh:"); section.starts_with("mesh"))
        scene.erase(mesh, scene.find('\n', mesh) - mesh);
      write("s.yaml", scene + section + "\n");
      const auto result = orthodyn("check s.yaml");
      EXPECT_EQ(result.exit_code, 2) << result.output.substr(0, 300) << section.substr(0, 60);
      EXPECT_NE(result.output.find("s.yaml:"), std::string::npos) << result.output.substr(0, 300);
    }
}

TEST_F(FileNames, OfTheCommandLine) {
  for (const std::string& name : names())
    for (const std::string& arguments :
         {"check " + name, "run " + name, "run " + name + " --resume", "modes " + name, "sweep " + name,
          "compare " + name, "verify " + name, "convert " + name + ".msh a.vtu", "check swing.yaml --plugin " + name}) {
      const auto result = orthodyn(arguments);
      EXPECT_EQ(result.exit_code, 2) << result.output.substr(0, 300) << arguments.substr(0, 60);
    }
}

}  // namespace
}  // namespace orthodyn::file_names_test
