// What `orthodyn check` says of the cost of terms, and of those that a scene could do without.
#include "lib/simulation/scene_cost.h"

#include <cmath>

#include "lib/analysis/static_response.h"
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

// The sentences that begin with a word, after changes to the beam.
std::vector<std::string> sentences(const std::vector<std::string>& changes, const std::string& first) {
  Config config = Config::from_text(kBeam);
  for (const auto& change : changes) config.override_with(change);
  const Setup setup = set_up(config);
  std::vector<std::string> found;
  for (const auto& text : dispensable(setup, term_costs(*setup.built.model, setup.built.initial, 0.01)))
    if (text.starts_with(first)) found.push_back(text);
  return found;
}

TEST(Dispensable, AreLoadsThatHardlyMoveTheBody) {
  EXPECT_TRUE(sentences({}, "gravity").empty());
  EXPECT_EQ(sentences({"gravity=[0,0,-1e-4]"}, "gravity").size(), 1u);
  EXPECT_TRUE(sentences({"gravity=[0,0,-1e-4]", "integrator.rtol=1e-8"}, "gravity").empty());
}

// 3/8 of the weight of a cantilever, upward at its tip, keeps the tip where it was: little work, and a twentieth of the
// sag.
TEST(Dispensable, IsNotALoadThatHoldsTheBodyUp) {
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

TEST(Dispensable, IsDampingThatHasNoTimeToAct) {
  // 16 Hz: beta omega^2 T/2 = 0.05 and 5e-6.
  EXPECT_TRUE(sentences({}, "damping").empty());
  EXPECT_EQ(sentences({"damping.stiffness=1e-8"}, "damping").size(), 1u);
}

TEST(Dispensable, AreElementsOfARegionThatIsNotStrained) {
  EXPECT_TRUE(sentences({}, "region").empty());
  const auto stiff = sentences({"materials.tip.young=1e13"}, "region tip");
  ASSERT_EQ(stiff.size(), 1u);
  EXPECT_NE(stiff[0].find("moves as a rigid body"), std::string::npos) << stiff[0];
}

TEST(Dispensable, AreLargeRotationsWhereTheResponseIsSmall) {
  EXPECT_TRUE(sentences({"loads.0.force=[0,0,-5000]"}, "large rotations").empty());
  EXPECT_EQ(sentences({"loads.0.force=[0,0,-1e-3]", "gravity=[0,0,-1e-6]", "integrator.rtol=1e-2"},
                      "large rotations").size(), 1u);
}

TEST(Dispensable, IsAMeshFinerThanTheToleranceAsks) {
  EXPECT_TRUE(sentences({}, "mesh").empty());
  EXPECT_EQ(sentences({"mesh.cells=[40,4,4]", "integrator.rtol=1e-1"}, "mesh").size(), 1u);
}

class Check : public InFolder {};

TEST_F(Check, MeasuresEachTerm) {
  write("beam.yaml", kBeam);
  const auto said = orthodyn("check beam.yaml");
  ASSERT_EQ(said.exit_code, 0) << said.output;
  for (const char* part : {"cost of one evaluation, measured", "elasticity of region body", "elasticity of region tip",
                           "gravity", "traction on x1", "could be left out at an accuracy of 1e-03"})
    EXPECT_NE(said.output.find(part), std::string::npos) << part << "\nin: " << said.output;
}

}  // namespace
}  // namespace orthodyn::scene_cost_test
