// The integrator that chooses: says what and why, does what the chosen one does.
#include "tests/contract/integrators.h"

namespace orthodyn {
namespace {

std::unique_ptr<Integrator> make(const SmallModel& model, const std::string& options) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{" + options + "}", "a.yaml"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

std::map<std::string, std::string> decisions(const Integrator& integrator) {
  const auto all = integrator.decisions();
  return {all.begin(), all.end()};
}

TEST(Automatic, TakesStepsOfTheMethodThatItNames) {
  for (const std::string rtol : {"1e-3", "1e-6"}) {
    const auto model = chain(false);
    const auto automatic = make(model, "type: auto, rtol: " + rtol);
    const auto said = decisions(*automatic);
    EXPECT_FALSE(said.at("because").empty());
    const std::string method = said.at("method");
    const auto named = make(model, "type: " + method + (has_key(method, "rtol") ? ", rtol: " + rtol : "") +
                                       (said.contains("safety") ? ", safety: " + said.at("safety") : ""));
    const State a = integrate(model, *automatic), b = integrate(model, *named);
    EXPECT_EQ(a.q, b.q);
    EXPECT_EQ(automatic->statistics().steps, named->statistics().steps);
  }
}

TEST(Automatic, SaysWhatItWouldReadAgain) {
  const auto model = pendulum();
  const auto said = decisions(*make(model, "type: auto, rtol: 1e-5"));
  const auto again = decisions(*make(model, "type: auto, rtol: 1e-5, method: " + said.at("method") + ", because: '" + said.at("because") + "'"));
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
}  // namespace orthodyn
