// The registry of integrators: each one is covered by this suite, documented and distinct.
#include "tests/contract/integrators.h"

namespace orthodyn::registry_test {
namespace {

TEST(IntegratorRegistry, HoldsOnlyWhatThisSuiteTests) {
  std::vector<std::string> known;
  for (const auto& [name, method] : tested_methods()) known.push_back(name);
  EXPECT_EQ(Registry<IntegratorChoice>::names(), known);
}

TEST(IntegratorRegistry, TellsOrderStabilityInvariantsAndSourceOfEach) {
  for (const auto& [name, entry] : Registry<IntegratorChoice>::entries()) {
    std::vector<std::string> told;
    for (const auto& [fact, text] : entry.facts) {
      told.push_back(fact);
      EXPECT_FALSE(text.empty()) << name << ": " << fact;
    }
    EXPECT_EQ(told, (std::vector<std::string>{"order", "stability", "conserves", "source"})) << name;
  }
}

// One step of fixed-step methods with their defaults, a whole run of the others, on a nonlinear, damped model.
State moved(const std::string& integrator) {
  const SpringPendulum model{Vector{{1.1, 0}}, 0.5};
  const Pair pair{integrator, tried_solvers(integrator).front()};
  if (!has_key(integrator, "step")) return integrate(model, *make_integrator(pair, model, {1e-4, 2}));
  const std::string rtol = controls_its_error(integrator) ? ", rtol: 1e-10" : "";
  const auto choice = Registry<IntegratorChoice>::read(
      Config::from_text("{type: " + integrator + tested(integrator).needs + rtol + ", step: 0.05}"));
  const auto made = choice->make(model, {[&] { return model.scales(); }, model.initial(), 1, 1});
  State state = model.initial();
  made->start(state);
  made->interpolate(made->step(0.05).t, state);
  return state;
}

TEST(IntegratorRegistry, HasNoTwoNamesForOneMap) {
  std::map<std::string, State> states;
  for (const auto& [name, method] : tested_methods()) {
    if (method.chooses || method.linear_only) continue;
    const State state = moved(name);
    for (const auto& [other, theirs] : states)
      if (has_key(name, "step") == has_key(other, "step")) {
        EXPECT_GT(distance(state, theirs, {1, 20}), 1e-9) << name << " and " << other;
      }
    states[name] = state;
  }
}

}  // namespace
}  // namespace orthodyn::registry_test
