// The integrator `auto`: reports its choice and reasons, and gives the same result as the chosen one.
#include <fmt/format.h>

#include <set>

#include "integrators/automatic/modal_plan.h"
#include "integrators/error_control.h"
#include "tests/contract/integrators.h"

namespace orthodyn::automatic_test {
namespace {

std::unique_ptr<Integrator> make(const SmallModel& model, const std::string& options) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{" + options + "}", "a.yaml"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

std::map<std::string, std::string> decisions(const Integrator& integrator) {
  const auto all = integrator.decisions();
  return {all.begin(), all.end()};
}

// Choice by estimated cost; the thresholds are tested in cost_estimate_test.cc.
MethodChoice expected_choice(const SmallModel& model, double rtol) {
  const Task task{[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50};
  ErrorControl control;
  control.rtol = rtol;
  const CostEstimate cost = estimate_cost(model, task, model.scales(), "cholesky");
  const MethodChoice stepping = choose_method(cost, rtol, static_cast<double>(control.max_steps));
  return plan_modal(model, task, cost, control, stepping).value_or(stepping);
}

TEST(Automatic, TakesTheMethodOfItsEstimate) {
  std::set<std::string> methods;
  const auto slow = chain(false);
  const auto stiff = stiff_pair();
  for (const SmallModel* model : {static_cast<const SmallModel*>(&slow), static_cast<const SmallModel*>(&stiff)})
    for (const double rtol : {1e-3, 1e-6}) {
      const auto expected = expected_choice(*model, rtol);
      const auto said = decisions(*make(*model, fmt::format("type: auto, rtol: {}", rtol)));
      EXPECT_EQ(said.at("method"), expected.method);
      EXPECT_EQ(said.at("because"), expected.rationale);
      EXPECT_EQ(said.contains("safety"), expected.safety.has_value());
      EXPECT_EQ(said.contains("modes"), expected.modes.has_value());
      methods.insert(expected.method);
    }
  EXPECT_GE(methods.size(), 2u);  // the choice affects the result
}

TEST(Automatic, TakesTheStepsThatTheMethodTakesWithItsOptions) {
  const auto model = chain(false);
  for (const std::string method : {"sdirk", "cvode_bdf", "central_differences"})
    for (const std::string options : {"rtol: 1e-3", "rtol: 1e-6, h_max: 0.01", "safety: 0.3", "linear_solver: klu"}) {
      const std::string key = options.substr(0, options.find(':'));
      if (!has_key(method, key)) continue;
      const auto automatic = make(model, "type: auto, method: " + method + ", " + options);
      const auto named = make(model, "type: " + method + ", " + options);
      const State a = integrate(model, *automatic), b = integrate(model, *named);
      EXPECT_EQ(a.q, b.q) << method << ", " << options;
      EXPECT_EQ(automatic->statistics().steps, named->statistics().steps) << method << ", " << options;
      if (key == "linear_solver") {
        EXPECT_TRUE(decisions(*automatic).at(key).starts_with("klu"));
      }
    }
}

// Two masses between springs over many periods.
LinearModel two_masses(const std::vector<std::array<double, 2>>& factor = {}) {
  const Matrix K = (Matrix(2, 2) << 6, -2, -2, 4).finished(), M = (Matrix(2, 2) << 2, 0, 0, 1).finished();
  const Vector load = factor.empty() ? Vector() : Vector::Unit(2, 1);
  return LinearModel(
      {.mass = M, .stiffness = K, .load = load, .factor = factor, .start = Vector::Unit(2, 0), .end = 500});
}

TEST(Automatic, TakesTheModesOfALinearModelOverManyPeriods) {
  const auto model = two_masses();
  const auto integrator = make(model, "type: auto, rtol: 1e-6");
  EXPECT_EQ(decisions(*integrator).at("method"), "modal");
  EXPECT_EQ(decisions(*integrator).at("modes"), "2");
  const State last = integrate(model, *integrator);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-9);
  const auto nonlinear = pendulum();
  EXPECT_FALSE(decisions(*make(nonlinear, "type: auto, rtol: 1e-6")).contains("modes"));
}

// A recorded choice of modes is kept if the model still has modes, otherwise repeated.
TEST(Automatic, ChoosesAnewWhereRecordedModesServeNoLonger) {
  EXPECT_NE(decisions(*make(pendulum(), "type: auto, method: modal, modes: 2")).at("method"), "modal");
  EXPECT_EQ(decisions(*make(two_masses(), "type: auto, method: modal, modes: 2")).at("modes"), "2");
  EXPECT_THROW(make(two_masses(), "type: auto, modes: 2"), ConfigError);
}

TEST(Automatic, TakesNoModesWithinFewerStepsThanTheyTake) {
  const auto many_kinks = two_masses({{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}});
  EXPECT_NE(decisions(*make(many_kinks, "type: auto, rtol: 1e-6, max_steps: 3")).at("method"), "modal");
}

// A model declared linear whose tangent omits a damping in its force.
class Forgetful : public SmallModel {
 public:
  Forgetful() : SmallModel(scalar(1)) { traits_.linear = true; }
  void force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override { f = -q - 0.1 * v; }
  State initial() const override { return {0, Vector::Ones(1), Vector::Zero(1)}; }
  double end() const override { return 500; }

 private:
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return scalar(1); }
};

TEST(Automatic, TakesNoModesOfAForceThatIsAnother) {
  EXPECT_NE(decisions(*make(Forgetful(), "type: auto, rtol: 1e-6")).at("method"), "modal");
}

TEST(Automatic, GivesUpAfterItsOwnMaximumOfSteps) {
  const auto model = chain(false);
  const auto automatic = make(model, "type: auto, method: sdirk, max_steps: 3");
  EXPECT_THROW(integrate(model, *automatic), RunError);
  EXPECT_EQ(automatic->statistics().steps, 3);
}

TEST(Automatic, SaysWhatItWouldReadAgain) {
  const auto model = pendulum();
  const auto said = decisions(*make(model, "type: auto, rtol: 1e-5"));
  const auto again = decisions(
      *make(model, "type: auto, rtol: 1e-5, method: " + said.at("method") + ", because: '" + said.at("because") + "'"));
  EXPECT_EQ(again.at("method"), said.at("method"));
  EXPECT_EQ(again.at("because"), said.at("because"));
}

TEST(Automatic, TakesWhatItIsToldTo) {
  const auto model = pendulum();
  EXPECT_EQ(decisions(*make(model, "type: auto, method: sdirk")).at("method"), "sdirk");
}

TEST(Automatic, TakesLongStepsWhereStiffPartsAreDamped) {
  const auto model = stiff_pair();
  const auto integrator = make(model, "type: auto, rtol: 1e-4");
  const State last = integrate(model, *integrator);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-2);
  EXPECT_LE(integrator->statistics().steps, 1000);  // an explicit method would take millions
}

TEST(Automatic, RefusesAMethodThatThereIsNotWithTheNearest) {
  try {
    make(pendulum(), "type: auto, method: newmrk");
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'newmark'?"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("a.yaml:1:"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace orthodyn::automatic_test
