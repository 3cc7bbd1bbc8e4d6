// Linear solvers as scenes name them: PETSc's options, and a solution that does not converge.
#include "lib/linear/solver.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::linear_solver_test {
namespace {

class PetscInAScene : public Resume, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (!solver_registry().at("petsc").unavailable.empty()) GTEST_SKIP() << "built without PETSc";
    write("beam.yaml", R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [6, 2, 2], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 5], factor: {type: sine, frequency: 1.5}}]
output: {frames: 4, probes: {tip: {at: [1, 0.1, 0.1]}}}
time: {end: 0.2}
integrator: {rtol: 1e-4}
)");
  }

  void run(const std::string& options, const std::string& out) const {
    const auto result = orthodyn("run beam.yaml --quiet --integrator " + std::string(GetParam()) + " --out " + out +
                                 " --set 'integrator.linear_solver={type: petsc, options: \"" + options + "\"}'");
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const std::string told = record(out).at("integrator").at("linear_solver");
    EXPECT_TRUE(told.starts_with("petsc " + options + " (cg, jacobi, ")) << told;
  }
};

TEST_P(PetscInAScene, ASolutionThatDoesNotConvergeShortensTheStep) {
  run("-pc_type jacobi", "free");
  run("-pc_type jacobi -ksp_max_it 2", "short");
  const auto free = record("free").at("statistics"), shortened = record("short").at("statistics");
  EXPECT_EQ(free.at("rejected_steps"), 0);
  EXPECT_GE(shortened.at("rejected_steps"), 3);
  EXPECT_GE(shortened.at("steps").get<int>(), 2 * free.at("steps").get<int>());
  const double tip = read_rows(folder_ / "free/probes.csv").back()[3];
  EXPECT_NEAR(read_rows(folder_ / "short/probes.csv").back()[3], tip, 1e-3 * std::abs(tip));
}

INSTANTIATE_TEST_SUITE_P(Integrators, PetscInAScene, testing::Values("generalized_alpha", "cvode_bdf", "arkode_dirk"),
                         [](const auto& integrator) { return std::string(integrator.param); });

}  // namespace
}  // namespace orthodyn::linear_solver_test
