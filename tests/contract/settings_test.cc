// Every integrator reports and accepts the settings for which it has keys.
#include "tests/contract/integrators.h"

namespace orthodyn::settings_test {
namespace {

std::vector<std::string> all_integrators() {
  std::vector<std::string> names;
  for (const auto& [name, entry] : Registry<IntegratorChoice>::entries()) names.push_back(name);
  return names;
}

class EveryChoice : public testing::TestWithParam<std::string> {
 protected:
  const Registry<IntegratorChoice>::Entry& entry_ = Registry<IntegratorChoice>::entries().at(GetParam());
  bool has(const std::string& key) const { return has_key(GetParam(), key); }
};

TEST_P(EveryChoice, TakesWhatItHasAKeyForAndTellsItAgain) {
  const IntegratorSettings wanted{.rtol = 3e-5,
                                  .step = 0.25,
                                  .h0 = 1e-4,
                                  .h_min = 1e-9,
                                  .h_max = 0.5,
                                  .position_scale = 2,
                                  .velocity_scale = 3,
                                  .safety = 0.5,
                                  .max_steps = 77,
                                  .linear_solver = "klu"};
  const IntegratorSettings got = entry_.make()->with(wanted)->settings();
  EXPECT_EQ(got.rtol, has("rtol") ? wanted.rtol : std::nullopt);
  EXPECT_EQ(got.step, has("step") ? wanted.step : std::nullopt);
  EXPECT_EQ(got.h0, has("h0") ? wanted.h0 : std::nullopt);
  EXPECT_EQ(got.h_min, has("h_min") ? wanted.h_min : std::nullopt);
  EXPECT_EQ(got.h_max, has("h_max") ? wanted.h_max : std::nullopt);
  EXPECT_EQ(got.position_scale, has("position_scale") ? wanted.position_scale : std::nullopt);
  EXPECT_EQ(got.velocity_scale, has("velocity_scale") ? wanted.velocity_scale : std::nullopt);
  EXPECT_EQ(got.safety, has("safety") ? wanted.safety : std::nullopt);
  EXPECT_EQ(got.max_steps, has("max_steps") ? wanted.max_steps : std::nullopt);
  EXPECT_EQ(got.linear_solver, has("linear_solver") ? wanted.linear_solver : std::nullopt);
}

TEST_P(EveryChoice, KeepsWhatIsNotChanged) {
  const auto choice = entry_.make();
  const auto changed = choice->with({.max_steps = 77});
  EXPECT_EQ(changed->settings().max_steps, 77);
  EXPECT_EQ(changed->settings().rtol, choice->settings().rtol);
  EXPECT_EQ(changed->settings().h_max, choice->settings().h_max);
  EXPECT_NE(choice->settings().max_steps, 77);
}

TEST_P(EveryChoice, RefusesWhatItsKeyWouldRefuse) {
  try {
    entry_.make()->with({.max_steps = 0});
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.message(), "max_steps: must be >= 1, found 0");
  }
  if (has("rtol")) {
    EXPECT_THROW(entry_.make()->with({.rtol = 0}), ConfigError);
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, EveryChoice, testing::ValuesIn(all_integrators()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace orthodyn::settings_test
