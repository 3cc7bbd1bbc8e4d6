// `orthodyn check`: cost of terms, and possible savings.
#include "lib/simulation/preflight/scene_cost.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/analysis/static_response.h"
#include "lib/simulation/preflight/run_cost.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::scene_cost_test {
namespace {

const std::string kBeam = R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [10, 1, 1], parts: {tip: {min: [0.75, 0, 0], max: [1, 0.1, 0.1]}}}
materials:
  soft: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}
  tip: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}
regions: {body: {material: soft}, tip: {material: tip}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -100]}]
gravity: [0, 0, -9.81]
damping: {stiffness: 1e-4}
time: {end: 0.1}
integrator: {type: cvode_bdf, rtol: 1e-3}
)";

// The savings that begin with a word, after changes to the beam.
std::vector<std::string> sentences(const std::vector<std::string>& changes, const std::string& first) {
  Config config = Config::from_text(kBeam);
  for (const auto& change : changes) config.override_with(change);
  const Setup setup = set_up(config);
  std::vector<std::string> found;
  for (const auto& text : possible_savings(setup, term_costs(*setup.built.model, setup.built.initial, 0.01)))
    if (text.starts_with(first)) found.push_back(text);
  return found;
}

TEST(PossibleSavings, AreLoadsThatHardlyMoveTheBody) {
  EXPECT_TRUE(sentences({}, "gravity").empty());
  EXPECT_EQ(sentences({"gravity=[0,0,-1e-4]"}, "gravity").size(), 1u);
  EXPECT_TRUE(sentences({"gravity=[0,0,-1e-4]", "integrator.rtol=1e-8"}, "gravity").empty());
}

// 3/8 of the weight of a cantilever, upward at its tip, keeps the tip where it was: little work, and a twentieth of the
// sag.
TEST(PossibleSavings, IsNotALoadThatHoldsTheBodyUp) {
  const std::string prop = "loads.0.force=[0,0,36.8]", rtol = "integrator.rtol=0.9";
  const auto response = [](const std::vector<std::string>& changes) {
    Config config = Config::from_text(kBeam);
    for (const auto& change : changes) config.override_with(change);
    const orthodyn::Setup setup = set_up(config);
    return static_response(*setup.built.model, setup.built.initial, setup.scene.time.end);
  };
  const StaticResponse all = response({prop}), alone = response({prop, "gravity=[0,0,0]"});
  EXPECT_LT(std::abs(alone.load.dot(all.displacement)), 0.09 * all.work);  // a tenth of this rtol
  EXPECT_GT(alone.displacement.lpNorm<Eigen::Infinity>(), 10 * all.displacement.lpNorm<Eigen::Infinity>());
  EXPECT_TRUE(sentences({prop, rtol}, "traction").empty());
  EXPECT_TRUE(sentences({prop, rtol}, "gravity").empty());
}

TEST(PossibleSavings, IsDampingThatHasNoTimeToAct) {
  // 16 Hz: beta omega^2 T/2 = 0.05 and 5e-6.
  EXPECT_TRUE(sentences({}, "damping").empty());
  EXPECT_EQ(sentences({"damping.stiffness=1e-8"}, "damping").size(), 1u);
}

TEST(PossibleSavings, AreElementsOfARegionThatIsNotStrained) {
  EXPECT_TRUE(sentences({}, "region").empty());
  const auto stiff = sentences({"materials.tip.young=1e13"}, "region tip");
  ASSERT_EQ(stiff.size(), 1u);
  EXPECT_NE(stiff[0].find("moves as a rigid body"), std::string::npos) << stiff[0];
}

TEST(PossibleSavings, AreLargeRotationsWhereTheResponseIsSmall) {
  EXPECT_TRUE(sentences({"loads.0.force=[0,0,-5000]"}, "large rotations").empty());
  EXPECT_EQ(
      sentences({"loads.0.force=[0,0,-1e-3]", "gravity=[0,0,-1e-6]", "integrator.rtol=1e-2"}, "large rotations").size(),
      1u);
}

TEST(PossibleSavings, IsAMeshFinerThanTheToleranceAsks) {
  EXPECT_TRUE(sentences({}, "mesh").empty());
  EXPECT_EQ(sentences({"mesh.cells=[40,4,4]", "integrator.rtol=1e-1"}, "mesh").size(), 1u);
}

class Check : public InFolder {};

// A block of rubber falls on the ground and bounces.
const std::string kBouncing = R"(
mesh: {type: box, size: [0.2, 0.2, 0.2], cells: [1, 1, 1], origin: [0, 0, 0.1], order: 1}
materials: {rubber: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
gravity: [0, 0, -10]
terms: [{type: ground_contact, stiffness: 1e7}]
time: {end: 0.5}
integrator: {type: cvode_bdf, rtol: 1e-4}
output: {probes: {corner: {at: [0, 0, 0.1]}}}
)";

// A ground too stiff for its frequency to be relevant, and a run that an event ends at once.
TEST_F(Check, ForetellsTheStepsOfContactAndEvents) {
  write("block.yaml", kBouncing);
  const std::string stop = "events=[{quantity: corner.displacement.z, crosses: -0.01, action: stop}]";
  const std::string soft = "terms.0.stiffness=1e5", stiff = "terms.0.stiffness=1e12";
  for (const std::string& change : {soft, stiff, stop}) {
    Config config = Config::from_text(kBouncing);
    config.override_with(change);
    const orthodyn::Setup setup = set_up(config);
    setup.integrator->start(setup.built.initial);
    const RunCost cost = run_cost(setup, term_costs(*setup.built.model, setup.built.initial, 0.01));
    ASSERT_EQ(orthodyn("run block.yaml --quiet --force --set '" + change + "'").exit_code, 0);
    const double steps = nlohmann::json::parse(read_text(folder_ / "out/block/run.json")).at("statistics").at("steps");
    EXPECT_LE(cost.steps.least, steps) << change;
    EXPECT_GE(cost.steps.most, steps) << change;
  }
}

// Extremes of a dense history dominate the cost of this run.
TEST_F(Check, CountsOutputs) {
  Config config = Config::from_text(kBeam);
  config.override_with("output={frames: 5, history: {interval: 1e-5}, extremes: [von_mises.largest]}");
  const orthodyn::Setup setup = set_up(config);
  setup.integrator->start(setup.built.initial);
  const RunCost cost = run_cost(setup, term_costs(*setup.built.model, setup.built.initial, 0.01));
  EXPECT_EQ(cost.rows.least, 10000);
  EXPECT_EQ(cost.rows.most, 10000);
  EXPECT_EQ(cost.frames, 5);
  EXPECT_GT(cost.row, 0);
  EXPECT_GE(cost.seconds().least, 10000 * cost.row);
}

TEST_F(Check, SaysWhyStepsOfContactAndEventsAreUncertain) {
  write("block.yaml", kBouncing);
  const auto said = orthodyn("check block.yaml");
  EXPECT_NE(said.output.find("small during contact;"), std::string::npos) << said.output;
  EXPECT_EQ(said.output.find("an event may end the run"), std::string::npos) << said.output;
  const auto ended =
      orthodyn("check block.yaml --set 'events=[{quantity: corner.displacement.z, crosses: -0.01, action: stop}]'");
  EXPECT_NE(ended.output.find("an event may end the run"), std::string::npos) << ended.output;
}

TEST_F(Check, MeasuresEachTerm) {
  write("beam.yaml", kBeam);
  const auto said = orthodyn("check beam.yaml");
  ASSERT_EQ(said.exit_code, 0) << said.output;
  for (const char* part : {"cost of one evaluation, measured", "elasticity of region body", "elasticity of region tip",
                           "gravity", "traction on x1", "rows of tables", "could be left out at an accuracy of 1e-03"})
    EXPECT_NE(said.output.find(part), std::string::npos) << part << "\nin: " << said.output;
}

}  // namespace
}  // namespace orthodyn::scene_cost_test
