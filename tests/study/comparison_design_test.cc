// The points of a comparison file.
#include "lib/study/compare/comparison_design.h"

#include <limits>
#include <map>

#include "lib/config/registry.h"
#include "lib/ode/integrator.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::study::compare::comparison_design_test {
namespace {

class Expand : public InFolder {
 protected:
  Expand() { write("swing.yaml", kSwing); }

  Design expanded(const std::string& comparison) const {
    return expand(read_comparison(Config::from_file(write("c.yaml", comparison).string())));
  }
  std::string refusal(const std::string& comparison) const {
    try {
      expanded(comparison);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(Expand, TakesEveryRegisteredIntegratorAndOrdersTolerancesFromLooseToTight) {
  const auto design = expanded("scenes: [swing.yaml]\ntolerances: [1e-4, 1e-2]\n");
  const auto names = Registry<IntegratorChoice>::names();
  ASSERT_EQ(design.methods.size(), names.size());
  for (std::size_t m = 0; m < names.size(); ++m) EXPECT_EQ(design.methods[m].integrator, names[m]);
  EXPECT_EQ(design.points[0].control, 1e-2);
  EXPECT_EQ(design.points[1].control, 1e-4);
}

// central_differences has no tolerance.
TEST_F(Expand, GivesAnExplicitMethodSharesOfItsCriticalStep) {
  const auto design =
      expanded("scenes: [swing.yaml]\nintegrators: [cvode_bdf, central_differences]\ntolerances: [1e-2]\n");
  ASSERT_EQ(design.points.size(), 4u);
  EXPECT_EQ(design.methods[1].control, Method::Control::safety);
  EXPECT_EQ(design.points[1].control, 0.9);
  EXPECT_EQ(point_scene(design, design.points[3]).at("integrator").at("safety").number(), 0.225);
}

TEST_F(Expand, KeysOfTheIntegratorMakeMethodsAndAllOthersMakeProblems) {
  const auto design = expanded(R"(scenes: [swing.yaml]
integrators: [cvode_bdf]
tolerances: [1e-3]
vary: {integrator.linear_solver: [klu, cholmod], mesh.cells: [[4, 1, 1], [8, 1, 1]]}
)");
  ASSERT_EQ(design.methods.size(), 2u);
  ASSERT_EQ(design.problems.size(), 2u);
  EXPECT_EQ(design.methods[0].label, "cvode_bdf, linear_solver klu");
  EXPECT_EQ(design.problems[1].label, "swing, cells [8, 1, 1]");
  EXPECT_EQ(design.points.size(), 4u);
  const Config scene = point_scene(design, design.points.back());
  EXPECT_EQ(scene.at("integrator").at("linear_solver").text(), "cholmod");
  EXPECT_EQ(scene.at("mesh").at("cells").yaml(), "[8, 1, 1]");
  EXPECT_EQ(scene.at("integrator").at("rtol").number(), 1e-3);
}

// Also for integrators without a varied key or with several kinds of error control.
TEST_F(Expand, AsManyPointsAreMadeAsWereCounted) {
  for (const char* text : {"scenes: [swing.yaml]\ntolerances: [1e-4, 1e-2]\n",
                           "scenes: [swing.yaml]\nintegrators: [cvode_bdf, central_differences, generalized_alpha]\n"
                           "tolerances: [1e-2, 1e-3]\nsteps: [1e-3]\n"
                           "vary: {integrator.linear_solver: [klu, cholmod], mesh.cells: [[4, 1, 1], [8, 1, 1]]}\n"}) {
    const auto comparison = read_comparison(Config::from_file(write("c.yaml", text).string()));
    EXPECT_EQ(number_of_points(comparison), static_cast<double>(expand(comparison).points.size())) << text;
  }
}

TEST_F(Expand, KeepsTheScalesOfTheSceneForEveryMethod) {
  write("scaled.yaml", std::string(kSwing).replace(std::string(kSwing).find("rtol: 1e-3"), 10, "position_scale: 0.25"));
  const auto design = expanded("scenes: [scaled.yaml]\nintegrators: [ida_bdf]\ntolerances: [1e-3]\n");
  EXPECT_EQ(point_scene(design, design.points[0]).at("integrator").at("position_scale").number(), 0.25);
}

TEST_F(Expand, AMethodWithBothKindsOfControlIsComparedWithBoth) {
  const auto design =
      expanded("scenes: [swing.yaml]\nintegrators: [arkode_dirk]\ntolerances: [1e-3, 1e-6]\nsteps: [0.02]\n");
  ASSERT_EQ(design.methods.size(), 2u);
  EXPECT_EQ(design.methods[1].label, "arkode_dirk, fixed step");
  ASSERT_EQ(design.points.size(), 3u);
  const Config integrator = point_scene(design, design.points[2]).at("integrator");
  EXPECT_EQ(integrator.at("step").number(), 0.02);
  EXPECT_EQ(integrator.at("rtol").number(), 1e-6);  // Newton's, no coarser than the comparison
}

TEST_F(Expand, AnOptionOfTheEntryWinsOverTheScene) {
  write("second.yaml", std::string(kSwing).replace(std::string(kSwing).find("rtol: 1e-3"), 10, "max_order: 2"));
  const auto design = expanded(
      "scenes: [second.yaml]\nintegrators: [{type: cvode_bdf, label: order 4, max_order: 4}]\ntolerances: [1e-3]\n");
  EXPECT_EQ(design.methods[0].label, "order 4");
  EXPECT_EQ(point_scene(design, design.points[0]).at("integrator").at("max_order").integer(), 4);
}

TEST_F(Expand, GivesEveryProblemAnIdOfItsOwn) {
  const auto design = expanded("scenes: [swing.yaml]\ntolerances: [1e-3]\nvary: {gravity: [[0, 0, -1], [0, 0, 1]]}\n");
  ASSERT_EQ(design.problems.size(), 2u);
  EXPECT_NE(design.problems[0].id, design.problems[1].id);
}

TEST_F(Expand, AFixedStepKnowsNoLimitsOfSteps) {
  write("limited.yaml", std::string(kSwing).replace(std::string(kSwing).find("rtol: 1e-3"), 10, "h_max: 0.1"));
  const auto design = expanded("scenes: [limited.yaml]\nintegrators: [arkode_dirk]\nsteps: [0.01]\n");
  EXPECT_FALSE(point_scene(design, design.points[0]).at("integrator").has("h_max"));
}

TEST_F(Expand, AReferenceTakesScalesFromTheSceneAndNothingElse) {
  write("own.yaml",
        std::string(kSwing).replace(std::string(kSwing).find("rtol: 1e-3"), 10, "max_steps: 7, velocity_scale: 2"));
  const auto design = expanded("scenes: [own.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-3]\n");
  const Config integrator = reference_scene(design.groups[0], design.check).at("integrator");
  EXPECT_EQ(integrator.at("velocity_scale").number(), 2);
  EXPECT_EQ(integrator.at("max_order").integer(), 5);
  EXPECT_NE(integrator.at("max_steps").integer(), 7);
  EXPECT_EQ(point_scene(design, design.points[0]).at("integrator").at("max_steps").integer(), 7);
}

TEST_F(Expand, ASceneThatIsEditedMeanwhileIsReadOnce) {
  const auto design = expanded("scenes: [swing.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-3]\n");
  write("swing.yaml", "broken");
  EXPECT_EQ(point_scene(design, design.points[0]).at("time").at("end").number(), 0.5);
}

TEST_F(Expand, WritesNothingButProbes) {
  const auto design = expanded("scenes: [swing.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-3]\n");
  const Config output = point_scene(design, design.points[0]).at("output");
  EXPECT_EQ(output.at("fields").size(), 0u);
  EXPECT_FALSE(output.at("energy").boolean());
  EXPECT_TRUE(output.at("probes").has("tip"));
}

TEST_F(Expand, RefusesWithPlaceAndRemedy) {
  const std::string good = "scenes: [swing.yaml]\n";
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nintegrators: [cvode]\n").find("c.yaml:3:15"), std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nintegrators: [cvode_bfd]\n").find("did you mean 'cvode_bdf'"),
            std::string::npos);
  EXPECT_NE(refusal(good).find("give 'tolerances', 'steps' or both"), std::string::npos);
  EXPECT_NE(refusal(good + "steps: [1e-3]\nintegrators: [cvode_bdf]\n").find("no integrator has the key 'step'"),
            std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [2]\n").find("c.yaml:2:14"), std::string::npos);
  EXPECT_NE(refusal("scenes: [swing.yaml, swing.yaml]\ntolerances: [1e-3]\n").find("twice"), std::string::npos);
  EXPECT_NE(refusal("scenes: [no.yaml]\ntolerances: [1e-3]\n").find("no.yaml: no such file"), std::string::npos);
  EXPECT_NE(refusal("scenes: [no.yaml]\ntolerances: [1e-3]\n").find("c.yaml:1:10: scenes.0: "), std::string::npos);
  EXPECT_NE(refusal("scenes: [{file: swing.yaml, set: {gravty: 1}}]\ntolerances: [1e-3]\n")
                .find("c.yaml:1:43: scenes.0.set.gravty: unknown key; did you mean 'gravity'"),
            std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nintegrators: [{type: cvode_bdf, max_ordr: 1}]\n")
                .find("c.yaml:3:43: integrators.0.max_ordr: unknown key"),
            std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nvary: {mesh.cels: [[1, 1, 1]]}\n")
                .find("c.yaml:3:20: vary.mesh.cels.0: unknown key; did you mean 'cells'"),
            std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nintegrators: [{type: cvode_bdf, rtol: 1}]\n").find("remove it here"),
            std::string::npos);
  EXPECT_NE(
      refusal(good + "tolerances: [1e-3]\nvary: {integrator.max_ordr: [1, 2]}\n").find("did you mean 'max_order'"),
      std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nvary: {integrator.rtol: [1, 2]}\n").find("remove it here"),
            std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3, 1e-3]\n").find("twice"), std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nvary: {mass: [lumped, lumped]}\n").find("c.yaml:3:23"),
            std::string::npos);
  EXPECT_NE(refusal(good + "tolerances: [1e-3]\nreference: {integrator: {type: arkod_dirk}}\n").find("c.yaml:3:32"),
            std::string::npos);
  const std::string tight = refusal(good + "integrators: [cvode_bdf]\ntolerances: [1e-3, 1e-16]\n");
  EXPECT_NE(tight.find("c.yaml:3:"), std::string::npos) << tight;
  EXPECT_NE(tight.find(": tolerances: "), std::string::npos) << tight;
}

TEST(HeadComment, IsOneLineOfText) {
  const auto text = head_comment(read_text(ORTHODYN_SOURCE_DIR "/configs/scenes/free_flight.yaml"));
  EXPECT_TRUE(text.starts_with("A block ten times stiffer")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

class ShippedComparisons : public testing::TestWithParam<std::string> {};

// Every method on every problem, from loose to tight; the scene of each point has its method and control value.
TEST_P(ShippedComparisons, MeasureEveryMethodOnEveryProblem) {
  const Comparison comparison = read_comparison(Config::from_file(GetParam()));
  const Design design = expand(comparison);
  const std::map<Method::Control, std::size_t> controls{{Method::Control::rtol, comparison.tolerances.size()},
                                                        {Method::Control::step, comparison.steps.size()},
                                                        {Method::Control::safety, 3}};
  auto point = design.points.begin();
  for (std::size_t p = 0; p < design.problems.size(); ++p) {
    for (std::size_t m = 0; m < design.methods.size(); ++m) {
      const Method& method = design.methods[m];
      double looser = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < controls.at(method.control); ++k, ++point) {
        ASSERT_NE(point, design.points.end());
        EXPECT_EQ(point->problem, p);
        EXPECT_EQ(point->method, m);
        EXPECT_LT(point->control, looser);
        looser = point->control;
        const Config integrator = point_scene(design, *point).at("integrator");
        EXPECT_EQ(integrator.at("type").text(), method.integrator);
        EXPECT_EQ(integrator.at(control_word(method.control)).number(), point->control);
      }
    }
  }
  EXPECT_EQ(point, design.points.end());
}

std::vector<std::string> shipped() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(ORTHODYN_SOURCE_DIR "/configs/comparisons"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  return files;
}

INSTANTIATE_TEST_SUITE_P(Configs, ShippedComparisons, testing::ValuesIn(shipped()),
                         [](const auto& tested) { return fs::path(tested.param).stem().string(); });

}  // namespace
}  // namespace orthodyn::study::compare::comparison_design_test
