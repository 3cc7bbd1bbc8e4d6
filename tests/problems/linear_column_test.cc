// Linear kinematics of a straight column, whose equilibrium is unstable above the buckling load.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/simulation/output/json.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::linear_column_test {
namespace {

// Five tetrahedra per cell: six equal ones would let an axial load bend the column slightly.
const char* const kColumn = R"(
mesh: {type: box, size: [1, 0.05, 0.01], cells: [10, 1, 1], order: 2, split: five}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
)";

class LinearColumn : public InFolder {};

// A straight bar under axial load deforms little and without rotation up to Euler's load, which `analysis: buckling`
// computes (tests/problems/buckling_test.cc).
TEST_F(LinearColumn, IsGivenUpWhereItBuckles) {
  const auto along = [](double force) { return fmt::format("loads: [{{surface: x1, force: [{}, 0, 0]}}]\n", force); };
  const std::string rest = "analysis: static\nelasticity: {kinematics: auto}\n";
  write("modes.yaml", kColumn + along(-1) + "analysis: buckling\nbuckling: {count: 1}\n");
  const auto modes = orthodyn("run modes.yaml --out modes");
  ASSERT_EQ(modes.exit_code, 0) << modes.output;
  const double critical = Json::parse(read_text(folder_ / "modes/run.json")).at("modes").at(0).at("load_factor");
  for (const auto& [share, word] :
       {std::pair{0.95, "linear: off by"}, {1.05, "buckles below these loads"}, {-2.0, "linear: off by"}}) {
    write("static.yaml", kColumn + along(-share * critical) + rest);
    const auto chosen = orthodyn("run static.yaml --force --out out");
    EXPECT_NE(chosen.output.find(word), std::string::npos) << share << '\n' << chosen.output;
    const auto by_hand = orthodyn("run static.yaml --force --out out --set elasticity.kinematics=linear");
    EXPECT_EQ(by_hand.output.find("warning: the body buckles") != std::string::npos, share > 1) << by_hand.output;
  }
}

}  // namespace
}  // namespace orthodyn::linear_column_test
