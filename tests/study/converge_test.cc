// Convergence studies: extrapolation, and the command.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/simulation/output/json.h"
#include "lib/study/converge/richardson.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::converge_test {
namespace {

using study::converge::extrapolate;

std::vector<double> sequence(double limit, double factor, double order, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(limit + factor * std::pow(2, -order * k));
  return out;
}

TEST(Richardson, FindsLimitAndOrderOfAPower) {
  for (const double order : {1.0, 1.5, 3.0})
    for (const double factor : {0.3, -0.3}) {
      const auto found = extrapolate(sequence(2, factor, order, 4), 2, 4);
      EXPECT_NEAR(found->limit, 2, 1e-12);
      EXPECT_NEAR(*found->order, order, 1e-9);
      const double last = std::abs(factor) * std::pow(2, -3 * order);
      EXPECT_NEAR(found->uncertainty, 1.25 * last, 1e-9 * last);
    }
}

TEST(Richardson, DoesNotTrustAnOrderThatTheElementsCannotHave) {
  EXPECT_NEAR(extrapolate(sequence(2, 1, 5, 3), 2, 2)->limit,
              2 + std::pow(2, -10) - (std::pow(2, -5) - std::pow(2, -10)) / 3, 1e-12);
}

TEST(Richardson, TakesTheFinestOfValuesThatOscillateALittle) {
  const auto found = extrapolate({1, 1.004, 1.001}, 2, 4);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->limit, 1.001);
  EXPECT_NEAR(found->uncertainty, 0.004, 1e-15);
  EXPECT_FALSE(found->order);
}

TEST(Richardson, FindsNoLimitWhereNoneIsApproached) {
  EXPECT_FALSE(extrapolate({1, 1.2, 1.1}, 2, 4));     // to and fro
  EXPECT_FALSE(extrapolate({1, 1.001, 0.98}, 2, 4));  // to and fro, ever more
  EXPECT_FALSE(extrapolate({1, 1.1, 1.3}, 2, 4));     // away
  EXPECT_FALSE(extrapolate({1, 1.1, 1.19}, 2, 4));    // hardly slower
  EXPECT_FALSE(extrapolate({5, 1, 1.1, 1.3}, 2, 4));  // the last three count
  EXPECT_FALSE(extrapolate({1, 1.1}, 2, 4));
  EXPECT_FALSE(extrapolate({1}, 2, 4));
}

TEST(Richardson, TakesValuesThatAreTheSameForTheirLimit) {
  const auto same = extrapolate({3, 3 * (1 + 1e-13), 3 * (1 - 1e-13)}, 2, 4);
  EXPECT_NEAR(same->limit, 3, 1e-12);
  EXPECT_LT(same->uncertainty, 1e-11);
}

// Without lateral contraction (nu = 0) the clamp causes no disturbance: Timoshenko's beam, shear factor 5/6.
const char* const kBeam = R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [8, 1, 1]}
materials: {m: {type: isotropic, density: 1, young: 1e9, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
analysis: static
output: {probes: {tip: {at: [1, 0.05, 0.05]}}}
)";

class Converge : public InFolder {
 protected:
  Converge() { write("beam.yaml", kBeam); }
  CommandResult converge(const std::string& more = "") const {
    return orthodyn("converge beam.yaml --no-report " + more);
  }
  Json table() const { return Json::parse(read_text(folder_ / "out/convergence/beam/convergence.json")); }
};

TEST_F(Converge, FindsTheLimitThatBeamTheoryKnows) {
  const auto done = converge();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json all = table(), metric = all.at("metrics")[0];
  EXPECT_EQ(metric.at("name"), "tip.displacement.magnitude");
  const double I = 1e-4 / 12, expected = 1 / (3 * 1e9 * I) + 1 / (5.0 / 6 * 0.5e9 * 0.01);
  EXPECT_NEAR(metric.at("limit").get<double>(), expected, 2e-3 * expected);
  ASSERT_EQ(all.at("rows").size(), 6u);
  double coarse = 1;
  for (const auto& row : all.at("rows")) {
    const double error = row.at("metrics").at("tip.displacement.magnitude").at("error");
    const double value = row.at("metrics").at("tip.displacement.magnitude").at("value");
    EXPECT_NEAR(error, std::abs(value / metric.at("limit").get<double>() - 1), 1e-12);
    if (row.at("level") != 1) {
      EXPECT_LT(error, coarse);
    }
    coarse = error;
    // The error estimate of each mesh against the refined limit; the deflection is proportional to the energy here.
    const double estimate = row.at("metrics").at("tip.displacement.magnitude").at("mesh_error");
    EXPECT_GT(estimate, 0.5 * error);
    EXPECT_LT(estimate, 1.5 * error);
  }
  EXPECT_EQ(all.at("rows")[2].at("elements"), 8 * 64 * 5);
  EXPECT_NE(done.output.find("CPU time for an error of 1 %"), std::string::npos) << done.output;
  const std::string csv = read_text(folder_ / "out/convergence/beam/convergence.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(converge().output.find("done before"), std::string::npos);
}

TEST_F(Converge, LooksAtModesAndAtWhatIsAskedFor) {
  ASSERT_EQ(converge("--levels 2 --order 2 --modes 2 --quantity energy.elastic").exit_code, 0);
  const Json all = table();
  ASSERT_EQ(all.at("metrics").size(), 3u);
  EXPECT_EQ(all.at("metrics")[0].at("name"), "energy.elastic");
  EXPECT_EQ(all.at("metrics")[1].at("unit"), "Hz");
  EXPECT_EQ(all.at("rows").size(), 2u);
}

TEST_F(Converge, ModesHaveTheirOwnCostAndTheirOwnEstimate) {
  ASSERT_EQ(converge("--levels 2 --order 2 --modes 1 --quantity energy.elastic").exit_code, 0);
  const Json all = table();
  for (const auto& row : all.at("rows")) {
    const Json& of_mode = row.at("metrics").at("frequency of mode 1");
    const Json& of_statics = row.at("metrics").at("energy.elastic");
    EXPECT_NE(of_mode.at("mesh_error"), 0);  // negative where the lumped mass lowers it by more than the mesh raises it
    EXPECT_LT(std::abs(of_mode.at("mesh_error").get<double>()), 0.05);
    EXPECT_TRUE(of_statics.at("mesh_error").is_number());
    EXPECT_NE(of_mode.at("cpu_seconds"), of_statics.at("cpu_seconds"));
  }
}

// Bending of quadratic elements with 16 cells along the beam: well below 1 %.
TEST_F(Converge, TellsThatTheCoarsestMeshIsGoodEnough) {
  const auto done = converge("--levels 3 --order 2 --set mesh.cells=[12,1,1]");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  EXPECT_NE(done.output.find("CPU time for an error of 1 %: order 2: at most "), std::string::npos) << done.output;
}

TEST_F(Converge, TellsNoLimitOfTwoLevels) {
  const auto done = converge("--levels 2 --order 2");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json metric = table().at("metrics")[0];
  EXPECT_TRUE(metric.at("limit").is_null());
  EXPECT_EQ(done.output.find(" +- "), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("tip.displacement.magnitude has no limit yet: a limit needs three levels (--levels 3). "
                             "The finest mesh gives "),
            std::string::npos)
      << done.output;
  EXPECT_NE(done.output.find("with an estimated mesh error of "), std::string::npos) << done.output;
}

TEST_F(Converge, AnswersInASentence) {
  const auto done = converge("--order 2");
  EXPECT_NE(done.output.find("tip.displacement.magnitude is 4.02"), std::string::npos) << done.output;
  EXPECT_NE(done.output.find(" m +- "), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("; an error of 1 % takes "), std::string::npos) << done.output;
}

TEST_F(Converge, NamesTheNearestQuantities) {
  const auto done = converge("--quantity tip.displcement.z");
  EXPECT_NE(done.output.find("The nearest are tip.displacement.z, "), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("orthodyn list quantities"), std::string::npos) << done.output;
  EXPECT_EQ(done.output.find("momentum"), std::string::npos) << done.output;
  EXPECT_NE(orthodyn("list quantities").output.find("energy.elastic"), std::string::npos);
}

TEST_F(Converge, RefinesAMeshOfAFile) {
  ASSERT_EQ(orthodyn("check beam.yaml --set mesh.order=1").exit_code, 0);
  write("part.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
        "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
  write("file.yaml", R"(
mesh: {type: gmsh, file: part.msh}
materials: {m: {type: isotropic, density: 1, young: 1e9, nu: 0.2}}
elasticity: {kinematics: linear}
clamps: [{box: {min: [-1, -1, -1e-6], max: [1, 1, 1e-6]}}]
gravity: [0, 0, -10]
analysis: static
)");
  const auto done = orthodyn("converge file.yaml --order 1 --levels 3 --no-report");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json all = Json::parse(read_text(folder_ / "out/convergence/file/convergence.json"));
  for (std::size_t level = 0; level < 3; ++level) EXPECT_EQ(all.at("rows")[level].at("elements"), 1 << (3 * level));
}

TEST_F(Converge, RefusesWhatItCannotDo) {
  for (const auto& [options, message] : {std::pair{"--order 3", "--order: expected 1, 2 or 1,2, found '3'"},
                                         {"--quantity tip.nothing", "unknown quantity 'tip.nothing'"},
                                         {"--quantity tip.displacement", "choose .x, .y, .z or .magnitude"},
                                         {"--quantity \"max of tip.displacement.z\"", "a static analysis"}}) {
    const auto done = converge(options);
    EXPECT_EQ(done.exit_code, 2) << options;
    EXPECT_NE(done.output.find(message), std::string::npos) << done.output;
  }
}

}  // namespace
}  // namespace orthodyn::converge_test
