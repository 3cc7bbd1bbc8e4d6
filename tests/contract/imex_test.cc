// Additive Runge-Kutta methods: orders for each choice of the explicit part, and refusals.
#include "tests/contract/integrators.h"
#include "tests/contract/parted_model.h"

namespace orthodyn::imex_test {
namespace {

std::unique_ptr<Integrator> imex(const SmallModel& model, const std::string& keys) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: arkode_imex" + keys + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

double error_of(const PartedModel& model, const std::string& keys, double fraction = 1) {
  double largest = 0;
  integrate(model, *imex(model, keys), [&](const StepInfo& info, const Integrator& i) {
    State state;
    i.interpolate(info.t - (1 - fraction) * info.h, state);
    largest = std::max(largest, distance(state, model.exact(state.t), model.scales()));
  });
  return largest;
}

class Imex : public testing::TestWithParam<std::string> {};  // the explicit part
INSTANTIATE_TEST_SUITE_P(ExplicitParts, Imex, testing::Values("spring", "damper"));

TEST_P(Imex, ErrorFallsWithTheOrderThatTheTablesNameEndsIn) {
  const std::vector<double> steps = {0.1, 0.075, 0.05, 0.0375};
  for (const std::string table :
       {"ARK324L2SA_4_2_3", "ARK436L2SA_6_3_4", "ARK437L2SA_7_3_4", "ARK548L2SA_8_4_5", "ARK548L2SAb_8_4_5"}) {
    std::vector<double> errors;
    for (const double step : steps)
      errors.push_back(error_of(parted_oscillator(), fmt::format(", explicit: [{}], table: {}, step: {}, rtol: 1e-12",
                                                                 GetParam(), table, step)));
    EXPECT_NEAR(slope(steps, errors), table.back() - '0', 0.4) << table;
  }
}

TEST_P(Imex, ErrorFallsWithTheToleranceAtTheEndsOfStepsAndBetween) {
  for (const double fraction : {1.0, 0.4})
    expect_order(4, [&](double rtol) {
      return error_of(parted_oscillator(), fmt::format(", explicit: [{}], rtol: {}", GetParam(), rtol), fraction);
    });
}

// The load is usually the explicit part; here it has kinks.
TEST(Imex, TreatsAKinkedLoadExplicitly) {
  const PartedModel model({.mass = scalar(1),
                           .stiffness = scalar(9),
                           .beta = 0.05,
                           .load = Vector::Constant(1, 9),
                           .factor = {{1, 0}, {2, 1}},
                           .end = 4,
                           .velocity_scale = 3});
  EXPECT_LE(error_of(model, ", explicit: [load], rtol: 1e-6"), 1e-4);
}

// With an implicit stiff spring, steps are a thousand times above its explicit limit.
TEST(Imex, AStiffImplicitPartDoesNotLimitTheStep) {
  Matrix K(2, 2);
  K << 1 + 1e6, -1e6, -1e6, 1 + 1e6;
  const PartedModel model({.mass = Matrix::Identity(2, 2),
                           .stiffness = K,
                           .beta = 1e-9,
                           .load = Vector::Ones(2),
                           .start = Vector::Ones(2),
                           .end = 6});
  const auto integrator = imex(model, ", explicit: [load], rtol: 1e-4");
  const State last = integrate(model, *integrator);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-2);
  EXPECT_LE(integrator->statistics().steps, 200);
}

std::string reading_refusal(const SmallModel& model, const std::string& keys) {
  try {
    imex(model, keys);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(Imex, RefusesAnUnknownPartWithTheNearestAndAllNames) {
  const auto message = reading_refusal(parted_oscillator(), ", explicit: [sprung]");
  EXPECT_NE(message.find("no part 'sprung'; did you mean 'spring'?"), std::string::npos) << message;
  EXPECT_NE(message.find("its parts: spring, damper"), std::string::npos) << message;
}

TEST(Imex, RefusesASplitThatLeavesOneSideEmptyWithTheRemedy) {
  EXPECT_NE(reading_refusal(parted_oscillator(), ", explicit: []").find("arkode_dirk"), std::string::npos);
  EXPECT_NE(reading_refusal(parted_oscillator(), ", explicit: [spring, damper]").find("arkode_erk"), std::string::npos);
}

// A model whose force has no named parts.
class Partless : public LinearModel {
 public:
  Partless() : LinearModel(damped_oscillator()) {}
  std::vector<std::string> force_parts() const override { return {}; }
};

TEST(Imex, RefusesAModelWithoutPartsWithTheRemedy) {
  const auto message = reading_refusal(Partless(), ", explicit: [spring]");
  EXPECT_NE(message.find("not divided into parts"), std::string::npos) << message;
  EXPECT_NE(message.find("arkode_dirk"), std::string::npos) << message;
}

}  // namespace
}  // namespace orthodyn::imex_test
