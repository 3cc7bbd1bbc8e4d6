// The exact solution of linear models satisfies the initial values and the equation of motion.
#include "lib/simulation/error_estimate/modal_solution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/simulation/run/setup.h"

namespace orthodyn::modal_solution_test {
namespace {

const std::string kLinear = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1], order: 1}
materials: {m: {type: orthotropic_stable, density: 1000, young: [2e6, 2e5, 1e5], nu: 0.3}}
elasticity: {kinematics: linear}
initial: {velocity: [0.1, 0, 0.3]}
time: {end: 1}
)";

Setup linear(const std::string& more) { return set_up(Config::from_text(kLinear + more)); }

// Residual M a - f with a from differences of the velocity; falls with h^2.
double residual(const Model& model, const ModalSolution& solution, double t, double h) {
  const State now = solution.at(t);
  Vector inertia(now.q.size()), force(now.q.size());
  model.multiply_mass((solution.at(t + h).v - solution.at(t - h).v) / (2 * h), inertia);
  model.force(t, now.q, now.v, force);
  return (inertia - force).norm();
}

double velocity_mismatch(const ModalSolution& solution, double t, double h) {
  return ((solution.at(t + h).q - solution.at(t - h).q) / (2 * h) - solution.at(t).v).norm();
}

class Modal : public testing::TestWithParam<const char*> {};

TEST_P(Modal, StartsAtTheInitialStateAndObeysTheEquationOfMotion) {
  const auto setup = linear(GetParam());
  const auto solution = ModalSolution::find(*setup.built.model, setup.built.initial);
  ASSERT_TRUE(solution.has_value());
  EXPECT_LT((solution->at(0).q - setup.built.initial.q).norm(), 1e-12);
  EXPECT_LT((solution->at(0).v - setup.built.initial.v).norm(), 1e-11);
  for (const double t : {0.013, 0.4}) {
    const double coarse = residual(*setup.built.model, *solution, t, 2e-5);
    const double fine = residual(*setup.built.model, *solution, t, 1e-5);
    EXPECT_NEAR(coarse / fine, 4, 0.4) << t;  // second order in h: the rest is the difference's own error
    EXPECT_NEAR(velocity_mismatch(*solution, t, 2e-5) / velocity_mismatch(*solution, t, 1e-5), 4, 0.4) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Modal,
                         testing::Values("clamps: [{surface: x0}]\n",
                                         "clamps: [{surface: x0}]\ndamping: {stiffness: 0.001, mass: 2}\n",
                                         "clamps: [{surface: x0}]\nmass: consistent\ngravity: [0, 0, -4]\n",
                                         "clamps: [{surface: x0}]\ndamping: {stiffness: 0.05}\n"));

TEST(Modal, AFreeBodyFallsAsItShould) {
  for (const double drag : {0.0, 1.5}) {
    const auto setup = linear("gravity: [0, 0, -4]\ndamping: {mass: " + number_text(drag) + "}\n");
    const auto solution = ModalSolution::find(*setup.built.model, setup.built.initial);
    ASSERT_TRUE(solution.has_value());
    const double t = 0.8, v = drag == 0 ? 0.3 - 4 * t : -4 / drag + (0.3 + 4 / drag) * std::exp(-drag * t);
    EXPECT_NEAR(
        setup.built.model->evaluate("momentum.linear", solution->at(t))[2] / setup.built.model->parts().mass->total(),
        v, 1e-9);
  }
}

// Stiffness damping does not act on rigid motion; round-off must not damp it.
TEST(Modal, AFreeBodyWithStiffnessDampingFallsFreely) {
  const auto setup = linear("gravity: [0, 0, -4]\ndamping: {stiffness: 0.05}\n");
  const auto solution = ModalSolution::find(*setup.built.model, setup.built.initial);
  ASSERT_TRUE(solution.has_value());
  EXPECT_NEAR(
      setup.built.model->evaluate("momentum.linear", solution->at(0.8))[2] / setup.built.model->parts().mass->total(),
      0.3 - 4 * 0.8, 1e-10);
}

TEST(Modal, DoesNotPretendForOtherModels) {
  const auto none = [](const std::string& scene) {
    const auto setup = set_up(Config::from_text(scene));
    return !ModalSolution::find(*setup.built.model, setup.built.initial).has_value();
  };
  const std::string corotational = std::string(kLinear).replace(kLinear.find("linear"), 6, "corotational");
  EXPECT_TRUE(none(corotational + "clamps: [{surface: x0}]\n"));
  EXPECT_TRUE(none(
      kLinear + "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [1, 0, 0], factor: {type: ramp, end: 0.5}}]\n"));
}

}  // namespace
}  // namespace orthodyn::modal_solution_test
