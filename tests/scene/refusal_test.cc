// Bad scenes: one clear message with file:line:column, what was found, what is allowed.
#include <sys/resource.h>

#include <cctype>

#include "lib/simulation/run/setup.h"
#include "tests/scene/scenes.h"

namespace orthodyn::refusal_test {
namespace {

struct BadScene {
  std::string name, from, to;
  std::vector<std::string> says;
};

class Refusal : public testing::TestWithParam<BadScene> {};

TEST_P(Refusal, NamesThePlaceAndTheRemedy) {
  const auto& bad = GetParam();
  const std::string message = refusal(replaced(kValidScene, bad.from, bad.to));
  for (const auto& part : bad.says) EXPECT_NE(message.find(part), std::string::npos) << part << "\nin: " << message;
  const std::string file = "scene.yaml:";  // followed by the line of the key, if it exists
  const bool is_missing = message.find("is missing") != std::string::npos;
  EXPECT_TRUE(is_missing || (message.starts_with(file) && std::isdigit(message[file.size()]))) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Refusal,
    testing::Values(
        BadScene{
            "unknown_key", "time: {end: 0.1}", "timme: {end: 0.1}", {"scene.yaml:6:8: timme", "did you mean 'time'"}},
        BadScene{"unknown_nested_key", "density", "densty", {"scene.yaml:3:35", "densty", "did you mean 'density'"}},
        BadScene{"wrong_type", "1000", "heavy", {"scene.yaml:3:36: materials.soft.density", "number", "'heavy'"}},
        BadScene{"negative_density", "1000", "-1", {"materials.soft.density", "> 0", "-1"}},
        BadScene{"nan", "1000", ".nan", {"materials.soft.density", ".nan"}},
        BadScene{"nan_by_word", "1000", "nan", {"materials.soft.density", "finite"}},
        BadScene{"poisson_out_of_range", "0.3", "0.5", {"materials.soft.nu", "(-1, 0.5)", "0.5"}},
        BadScene{"missing_time", "time: {end: 0.1}", "mass: lumped", {"'time' is missing"}},
        BadScene{"time_backwards", "0.1", "-1", {"scene.yaml:6:7: time", "after 'start'"}},
        BadScene{"unknown_material_type", "isotropic", "isotropi", {"materials.soft.type", "did you mean 'isotropic'"}},
        BadScene{"unknown_mesh_type", "type: box", "type: bax", {"mesh.type", "did you mean 'box'"}},
        BadScene{"flat_box", "[2, 1, 1], c", "[2, 0, 1], c", {"scene.yaml:1:29: mesh.size.1", "> 0"}},
        BadScene{"no_cells", "cells: [2, 1, 1]", "cells: [2, 0, 1]", {"mesh.cells.1"}},
        BadScene{
            "unknown_surface", "surface: x0", "surface: x9", {"scene.yaml:5:5: clamps.0", "no surface 'x9'", "x0"}},
        BadScene{"empty_selection",
                 "surface: x0",
                 "plane: {point: [9, 0, 0], normal: [1, 0, 0]}",
                 {"clamps.0", "selects no node", "[2, 1, 1]"}},
        BadScene{"two_selections", "surface: x0", "{surface: x0, nearest: [0, 0, 0]}", {"clamps.0", "exactly one"}},
        BadScene{
            "everything_clamped", "surface: x0", "box: {min: [-9, -9, -9], max: [9, 9, 9]}", {"all nodes are clamped"}},
        BadScene{"statics_of_a_term_at_no_time",
                 "time: {end: 0.1}",
                 "analysis: static\nterms: [{type: pressure, surface: x1, pressure: 1, factor: {type: ramp, end: 1}}]",
                 {"scene.yaml:7:9: terms.0", "varies in time", "time: {end: ...}"}},
        BadScene{"statics_of_a_motion_at_no_time",
                 "time: {end: 0.1}",
                 "analysis: static\nmotions: [{surface: x1, translation: [1, 0, 0], factor: {type: ramp, end: 1}}]",
                 {"scene.yaml:7:11: motions.0", "varies in time", "time: {end: ...}"}},
        BadScene{"statics_of_a_formula_at_no_time",
                 "time: {end: 0.1}",
                 "analysis: static\nmotions: [{surface: x1, displacement: [\"0.1*t\", \"0\", \"0\"]}]",
                 {"motions.0", "varies in time", "time: {end: ...}"}},
        BadScene{"equilibrium_of_a_given_shape",
                 "time:",
                 "start: equilibrium\ninitial: {displacement_field: [\"0\", \"0\", \"x\"]}\ntime:",
                 {"initial", "remove deformation_gradient, displacement_field"}},
        BadScene{"probe_that_breaks_the_csv",
                 "time:",
                 "output: {probes: {\"a,b\": {at: [0, 0, 0]}}}\ntime:",
                 {"output.probes.a,b", "commas"}},
        BadScene{"no_density", "1000", "1e-310", {"materials.soft.density", "1e-310", "0, or between"}},
        BadScene{"gravity_without_end",
                 "time:",
                 "gravity: [0, 0, 1e308]\ntime:",
                 {"scene.yaml:6:17: gravity.2", "1e+308", "out of range"}},
        BadScene{"too_long", "size: [2, 1, 1]", "size: [1e60, 1, 1]", {"mesh: extends", "unit of length"}},
        BadScene{"too_flat", "size: [2, 1, 1]", "size: [2, 1e-60, 1]", {"mesh: extends", "1e-50 m"}},
        BadScene{"more_elements_than_numbers",
                 "cells: [2, 1, 1]",
                 "cells: [1000000, 1000000, 1000000]",
                 {"scene.yaml:1:43: mesh.cells: 5e+18 elements; at most 5e+08 are allowed"}},
        BadScene{"missing_file",
                 "{type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}",
                 "{type: gmsh, file: nowhere.msh}",
                 {"nowhere.msh"}},
        BadScene{"unknown_region",
                 "time:",
                 "regions: {core: {material: soft}}\ntime:",
                 {"scene.yaml:6:17: regions.core", "no region 'core'", "body"}},
        BadScene{
            "unknown_material", "time:", "regions: {all: {material: hard}}\ntime:", {"regions.all", "'hard'", "soft"}},
        BadScene{"load_without_value",
                 "time:",
                 "loads: [{surface: x1}]\ntime:",
                 {"loads.0", "exactly one of traction, force"}},
        BadScene{"load_on_nothing",
                 "time:",
                 "loads: [{surface: tip, force: [1, 0, 0]}]\ntime:",
                 {"loads.0", "no surface 'tip'"}},
        BadScene{"descending_table",
                 "time:",
                 "loads: [{surface: x1, force: [1, 0, 0], factor: {type: table, points: [[0, 1], [0, 2]]}}]\ntime:",
                 {"loads.0.factor.points.1", "ascend"}},
        BadScene{"interval_and_frames",
                 "time:",
                 "output: {interval: 0.1, frames: 3}\ntime:",
                 {"output", "one of interval, frames"}},
        BadScene{"unknown_solver",
                 "time:",
                 "integrator: {type: cvode_bdf, linear_solver: colmod}\ntime:",
                 {"integrator.linear_solver", "did you mean 'cholmod'"}},
        BadScene{"unknown_solver_in_a_section",
                 "time:",
                 "integrator: {type: cvode_bdf, linear_solver: {type: colmod}}\ntime:",
                 {"integrator.linear_solver.type", "did you mean 'cholmod'"}},
        BadScene{"options_of_a_solver_without_any",
                 "time:",
                 "integrator: {type: tr_bdf2, linear_solver: {type: klu, options: -ksp_type cg}}\ntime:",
                 {"integrator.linear_solver.options", "'klu' takes no options"}},
        BadScene{"unstable_material",
                 "{type: isotropic, density: 1000, young: 1e6, nu: 0.3}",
                 "{type: orthotropic, density: 448, young: [1.188e10, 9.27e8, 5.11e8], nu12: 0.37, nu13: 0.43, nu23: "
                 "1.7, g12: 7.6e8, g23: 3.6e7, g13: 7.2e8}",
                 {"scene.yaml:3:9: materials.soft", "nu23=1.7", "indefinite", "smallest eigenvalue", "must lie in",
                  "Nearest stable set"}},
        BadScene{"the_other_ratio_of_a_pair",
                 "{type: isotropic, density: 1000, young: 1e6, nu: 0.3}",
                 "{type: orthotropic, density: 448, young: [5.11e8, 9.27e8, 1.188e10], nu12: 0.2, nu13: 0.43, nu23: "
                 "0.01, g12: 3.6e7, g23: 7.6e8, g13: 7.2e8}",
                 {"nu13=0.43", "the contraction along 1 when stretched along 3, give it as nu31"}}),
    [](const auto& scene) { return scene.param.name; });

// Lowers a limit that the system does not enforce.
class LittleMemory {
 public:
  LittleMemory() {
    getrlimit(RLIMIT_RSS, &before_);
    const rlimit little{1'000'000'000, before_.rlim_max};
    setrlimit(RLIMIT_RSS, &little);
  }
  ~LittleMemory() { setrlimit(RLIMIT_RSS, &before_); }
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;

 private:
  rlimit before_{};
};

TEST(MeshesToBeMade, ThatDoNotFitIntoTheMemoryAreRefusedWithWhatTheyNeed) {
  const LittleMemory little;
  const auto refused = [](const std::string& mesh) {
    return refusal(replaced(kValidScene, "{type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}", mesh));
  };
  EXPECT_NE(
      refused("{type: box, size: [2, 1, 1], cells: [1000, 1000, 1], order: 1}")
          .find(
              "mesh.cells: 5e+06 elements need at least 3 GB of memory, but only 1 GB are available; use fewer cells"),
      std::string::npos);
  EXPECT_NE(refused("{type: cylinder, radius: 1, length: 1, cells: [400, 100, 40], order: 1}")
                .find("mesh.cells: 1.2e+07 elements"),
            std::string::npos);
  EXPECT_NE(refused("{type: tube, radius: 1, inner_radius: 0.5, length: 1, cells: [400, 100, 40], order: 1}")
                .find("mesh.cells: 9.6e+06 elements"),
            std::string::npos);
}

TEST(TheStart, WhoseForceIsNoNumberIsRefusedAtItsPlace) {
  const auto refused = [](const std::string& more) -> std::string {
    try {
      set_up(Config::from_text(kValidScene + more, "scene.yaml"));
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refused("initial: {deformation_gradient: [[1, 0, 0], [0, 1e308, 0], [0, 0, 1e308]]}\n")
                .find("scene.yaml:7:10: initial: the force at the start cannot be evaluated"),
            std::string::npos);
  EXPECT_EQ(refused("initial: {deformation_gradient: [[0, 0, 0], [0, 0, 0], [0, 0, 0]]}\n"), "");  // in a point
}

}  // namespace
}  // namespace orthodyn::refusal_test
