// Comparisons whose reference has its own mesh, so that errors include the mesh error.
#include <cmath>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::compare_meshes_test {
namespace {

// A strip between walls that vibrates in shear along z. Without singular corners the order is observed.
const char* const kShear = R"yaml(mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e4, nu: 0}}
elasticity: {kinematics: linear}
mass: consistent
initial: {velocity_field: ["0", "0", "sin(pi*x)"]}
clamps: [{surface: x0}, {surface: x1}, {box: {min: [-1, -1, -1], max: [2, 2, 2]}, components: [x, y]}]
time: {end: 0.4}
integrator: {type: cvode_bdf, rtol: 1e-3}
output: {probes: {middle: {at: [0.5, 0.05, 0.05]}}}
)yaml";

class CompareMeshes : public InFolder {
 protected:
  CompareMeshes() { write("swing.yaml", kSwing); }

  Json table(const std::string& comparison) const {
    write("c.yaml", comparison);
    const auto done = orthodyn("compare c.yaml --no-report");
    EXPECT_EQ(done.exit_code, 0) << done.output;
    said_ = done.output;
    return Json::parse(read_text(folder_ / "out/comparisons/c/compare.json"));
  }
  std::string refusal(const std::string& comparison) const {
    write("c.yaml", comparison);
    const auto done = orthodyn("compare c.yaml --no-report");
    EXPECT_EQ(done.exit_code, 2);
    return done.output;
  }
  static double error(const Json& table, std::size_t point) {
    return table.at("points")[point].at("errors").at("displacement").at("l2");
  }
  mutable std::string said_;
};

// A linear scene on very coarse meshes, for speed.
const std::string kMeshes = R"(scenes: [{file: swing.yaml, set: {elasticity.kinematics: linear}}]
integrators: [cvode_bdf]
repeats: 1
samples: 40
)";
const std::string kReference = R"(  integrator: {type: cvode_bdf, max_order: 5, rtol: 1e-8}
  check: {type: ida_bdf, max_order: 5, rtol: 1e-8}
)";

TEST_F(CompareMeshes, ScenesThatDifferInTheirMeshesShareOneReference) {
  const Json t = table(kMeshes +
                       "tolerances: [1e-3]\n"
                       "vary: {mesh.order: [1, 2], mesh.cells: [[2, 1, 1], [3, 1, 1]], gravity: [[0, 0, -1], [0, 1, "
                       "0]]}\nreference:\n  set: {mesh.cells: [4, 1, 1], mesh.order: 2}\n" +
                       kReference);
  ASSERT_EQ(t.at("problems").size(), 8u);
  ASSERT_EQ(t.at("pareto_fronts").size(), 2u);  // one for each gravity
  std::size_t trajectories = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out/comparisons/c/references"))
    trajectories += entry.path().filename() == "trajectory.bin";
  EXPECT_EQ(trajectories, 2u);
  for (const auto& problem : t.at("problems")) {
    EXPECT_EQ(problem.at("reference").at("folder") == t.at("problems")[0].at("reference").at("folder"),
              problem.at("group") == t.at("problems")[0].at("group"));
    EXPECT_LT(problem.at("unknowns"), problem.at("reference").at("unknowns"));
  }
}

TEST_F(CompareMeshes, OnTheReferencesOwnMeshTheErrorIsThatOfTimeAlone) {
  const std::string points = kMeshes + "tolerances: [1e-3, 1e-5]\nvary: {mesh.cells: [[4, 1, 1]]}\nreference:\n";
  const Json own = table(points + kReference), across = table(points + "  set: {mesh.cells: [4, 1, 1]}\n" + kReference);
  ASSERT_EQ(own.at("points").size(), across.at("points").size());
  for (std::size_t k = 0; k < 2; ++k) {
    // The same runs: there in the mass norm of the whole body, here at the tip.
    EXPECT_GT(error(across, k), 0.3 * error(own, k));
    EXPECT_LT(error(across, k), 3 * error(own, k));
  }
  EXPECT_LT(error(across, 1), 3e-4);
}

TEST_F(CompareMeshes, TheErrorFallsWithTheMeshByTheOrderOfTheElements) {
  write("shear.yaml", kShear);
  const Json t = table(
      "scenes: [shear.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-8]\nrepeats: 1\nsamples: 40\n"
      "vary: {mesh.order: [1, 2], mesh.cells: [[4, 1, 1], [8, 1, 1]]}\n"
      "reference:\n  set: {mesh.cells: [32, 1, 1], mesh.order: 2}\n"
      "  integrator: {type: cvode_bdf, max_order: 5, rtol: 1e-9}\n"
      "  check: {type: ida_bdf, max_order: 5, rtol: 1e-8}\n");
  const double linear = std::log2(error(t, 0) / error(t, 1)), quadratic = std::log2(error(t, 2) / error(t, 3));
  EXPECT_GT(linear, 1.7);
  EXPECT_LT(linear, 2.3);
  EXPECT_GT(quadratic, 2.7);
}

TEST_F(CompareMeshes, TighterTolerancesDoNotMendTheErrorOfACoarseMesh) {
  const Json t = table(kMeshes +
                       "tolerances: [1e-1, 1e-4, 1e-6]\nvary: {mesh.cells: [[4, 1, 1]], mesh.order: [1]}\n"
                       "reference:\n  set: {mesh.cells: [8, 2, 2], mesh.order: 2}\n" +
                       kReference);
  EXPECT_NEAR(error(t, 1), error(t, 2), 0.01 * error(t, 2));
  EXPECT_GT(error(t, 2), 0.01);
  for (const auto& index : t.at("pareto_fronts")[0].at("points"))  // the tighter ones cost more and gain nothing
    EXPECT_LT(index.get<int>(), 3);
  EXPECT_TRUE(t.at("orders").empty());
}

TEST_F(CompareMeshes, TheFrontHoldsWhatNoOtherPointBeats) {
  const Json t = table(kMeshes +
                       "tolerances: [1e-1, 1e-3]\nvary: {mesh.cells: [[2, 1, 1], [4, 1, 1]], mesh.order: [1, "
                       "2]}\nreference:\n  set: {mesh.cells: [8, 2, 2], mesh.order: 2}\n" +
                       kReference);
  const Json& front = t.at("pareto_fronts")[0];
  const auto seconds = [&](std::size_t k) { return t.at("points")[k].at("cpu").at("median").get<double>(); };
  ASSERT_FALSE(front.at("points").empty());
  for (const std::size_t on : front.at("points"))
    for (std::size_t k = 0; k < t.at("points").size(); ++k)
      EXPECT_FALSE(seconds(k) < seconds(on) && error(t, k) < error(t, on)) << k << " beats " << on;
  ASSERT_FALSE(front.at("answers").empty());
  for (const auto& answer : front.at("answers")) {
    const std::size_t best = answer.at("point");
    EXPECT_LE(error(t, best), answer.at("target"));
    EXPECT_NE(said_.find(answer.at("words").get<std::string>()), std::string::npos) << said_;
  }
  EXPECT_NE(read_text(folder_ / "out/comparisons/c/compare.csv").find(",pareto_front\n"), std::string::npos);
}

TEST_F(CompareMeshes, AnotherMeshOfTheReferenceMeasuresAllPointsAgain) {
  const std::string points = kMeshes + "tolerances: [1e-2]\nvary: {mesh.cells: [[2, 1, 1]]}\nreference:\n";
  table(points + "  set: {mesh.cells: [4, 1, 1]}\n" + kReference);
  table(points + "  set: {mesh.cells: [4, 1, 1]}\n" + kReference);
  EXPECT_NE(said_.find("done before"), std::string::npos) << said_;
  table(points + "  set: {mesh.cells: [6, 1, 1]}\n" + kReference);
  EXPECT_EQ(said_.find("done before"), std::string::npos) << said_;
}

TEST_F(CompareMeshes, AReferenceOfAnotherMotionIsRefused) {
  const std::string points = kMeshes + "tolerances: [1e-2]\nreference: {set: ";
  for (const char* key : {"gravity: [0, 0, -2]", "time.end: 1", "mesh.size: [2, 1, 1]",
                          "mesh.parts.foot.max: [1, 1, 1]", "mesh.type: cylinder"}) {
    const std::string said = refusal(points + "{" + key + "}}\n");
    EXPECT_NE(said.find("c.yaml:6"), std::string::npos) << said;
    EXPECT_NE(said.find("mesh.cells, mesh.order"), std::string::npos) << said;
  }
  EXPECT_NE(refusal(points + "{mesh.order: 2}, kind: none}\n").find("has no effect with 'kind: none'"),
            std::string::npos);
}

TEST_F(CompareMeshes, KinematicsThatWouldBeChosenForEachToleranceAreRefused) {
  const std::string said = refusal(
      "scenes: [{file: swing.yaml, set: {elasticity.kinematics: auto}}]\nintegrators: [cvode_bdf]\n"
      "tolerances: [1e-2]\n");
  EXPECT_NE(said.find("kinematics: auto"), std::string::npos) << said;
}

TEST_F(CompareMeshes, ASceneWithoutProbesIsRefusedWithTheRemedy) {
  write("bare.yaml", std::string(kSwing).substr(0, std::string(kSwing).find("output:")));
  const std::string end =
      "integrators: [cvode_bdf]\ntolerances: [1e-2]\nrepeats: 1\nreference:\n  kind: automatic\n  set: {mesh.cells: "
      "[6, 1, 1]}\n" +
      kReference;
  const std::string said = refusal("scenes: [bare.yaml]\n" + end);
  EXPECT_NE(said.find("c.yaml:7"), std::string::npos) << said;
  EXPECT_NE(said.find("the scene bare has none"), std::string::npos) << said;
  const Json t = table("scenes: [{file: bare.yaml, set: {output.probes.tip.at: [1, 0, 0]}}]\n" + end);
  EXPECT_EQ(t.at("points")[0].at("status"), "completed");
}

}  // namespace
}  // namespace orthodyn::compare_meshes_test
