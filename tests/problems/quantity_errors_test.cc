// Estimated mesh errors of displacements and frequencies, against a finer mesh.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/analysis/displacement_error.h"
#include "lib/mesh/mesh.h"
#include "lib/simulation/modes/modal_analysis.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn::quantity_errors_test {
namespace {

const Vec3 kTip{1, 0.05, 0.05}, kMiddle{0.5, 0.05, 0.05};

struct Mesh {
  int order, fineness;
};

orthodyn::Setup set_up(const Mesh& mesh, const std::string& rest) {
  return orthodyn::set_up(Config::from_text(
      fmt::format("mesh: {{type: box, size: [1, 0.1, 0.1], cells: [{}, {}, {}], order: {}}}\n"
                  "materials: {{wood: {{type: orthotropic, density: 400, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: "
                  "0.44, nu23: 0.44, nu13: 0.53, g12: 0.69 GPa, g23: 0.032 GPa, g13: 0.66 GPa}}}}\n"
                  "regions: {{all: {{material: wood, axes: {{first: [1, 0.2, 0.1], second: [0, 1, 0]}}}}}}\n"
                  "clamps: [{{surface: x0}}]\n{}",
                  10 * mesh.fineness, mesh.fineness, mesh.fineness, mesh.order, rest)));
}

class Displacements : public testing::TestWithParam<const char*> {
 protected:
  struct Found {
    Vec3 tip, middle, tip_error, middle_error;
  };

  Found find(const Mesh& mesh) const {
    const orthodyn::Setup setup = set_up(
        mesh,
        fmt::format("loads: [{{surface: x1, force: [0, 0, {}]}}]\nanalysis: static\nelasticity: {{kinematics: {}}}\n",
                    GetParam() == std::string("linear") ? -10 : -1000, GetParam()));
    const FemModel& model = *setup.built.model;
    const State state{0, equilibrium(setup.scene, setup.built), Vector::Zero(model.num_dofs())};
    const std::vector<int> nodes{nearest_node(model.parts().mesh, kTip), nearest_node(model.parts().mesh, kMiddle)};
    const NodalExpansion nodal(model.parts(), 0, state.q, state.v);
    const auto errors = displacement_errors(model, state, nodes);
    return {nodal.u.col(nodes[0]), nodal.u.col(nodes[1]), errors[0], errors[1]};
  }
};
INSTANTIATE_TEST_SUITE_P(Kinematics, Displacements, testing::Values("linear", "corotational"),
                         [](const auto& kinematics) { return std::string(kinematics.param); });

TEST_P(Displacements, AreOffByWhatTheDualProblemSays) {
  const Found fine = find({2, 3});
  for (const Mesh& mesh : {Mesh{1, 3}, Mesh{2, 1}}) {
    SCOPED_TRACE(mesh.order);
    const Found coarse = find(mesh);
    const double tip = (fine.tip - coarse.tip)[2], middle = (fine.middle - coarse.middle)[2];
    EXPECT_GT(std::abs(tip), 0.002 * std::abs(fine.tip[2]));  // the error is not negligible
    EXPECT_GT(coarse.tip_error[2] / tip, 0.5);
    EXPECT_LT(coarse.tip_error[2] / tip, 1.5);
    EXPECT_GT(coarse.middle_error[2] / middle, 0.5);
    EXPECT_LT(coarse.middle_error[2] / middle, 1.5);
  }
}

TEST(HeldDisplacements, HaveNoError) {
  const orthodyn::Setup setup = set_up({2, 1}, "loads: [{surface: x1, force: [0, 0, -10]}]\nanalysis: static\n");
  const FemModel& model = *setup.built.model;
  const State state{0, equilibrium(setup.scene, setup.built), Vector::Zero(model.num_dofs())};
  const int held = nearest_node(model.parts().mesh, Vec3(0, 0.05, 0.05));
  EXPECT_EQ(displacement_errors(model, state, {held})[0], Vec3::Zero());
}

// Bending; and torsion, whose inertia is too large with the lumped mass of one element per section.
TEST(Frequencies, AreOffByWhatStressesAndMassSay) {
  const auto lowest = [](const Mesh& mesh, const std::string& mass) {
    const orthodyn::Setup setup = set_up(mesh, fmt::format("mass: {}\ntime: {{end: 1}}\n", mass));
    const ModalAnalysis analysis(setup, 6, false);
    std::vector<std::pair<double, double>> found;
    for (std::size_t k = 0; k < 6; ++k)
      found.emplace_back(analysis.modes().modes[k].frequency(), analysis.mesh_errors()[k]);
    return found;
  };
  const auto fine = lowest({2, 3}, "consistent");
  for (const auto& [mesh, mass] :
       {std::pair{Mesh{1, 3}, "lumped"}, {Mesh{2, 1}, "lumped"}, {Mesh{2, 1}, "consistent"}}) {
    SCOPED_TRACE(fmt::format("order {}, {}", mesh.order, mass));
    const auto coarse = lowest(mesh, mass);
    for (std::size_t k = 0; k < 2; ++k) {
      const double error = coarse[k].first / fine[k].first - 1;
      EXPECT_NEAR(coarse[k].second, error, 0.5 * std::abs(error)) << k << " " << coarse[k].first;
    }
  }
}

}  // namespace
}  // namespace orthodyn::quantity_errors_test
