// The default maximum order of the multistep methods, by the damping ratio of the motion.
#include <fmt/format.h>

#include "tests/contract/integrators.h"

namespace orthodyn::default_order_test {
namespace {

// A motion of 10 rad/s according to its scales.
LinearModel oscillator(double damping_ratio) {
  constexpr double kOmega = 10;
  return LinearModel({.mass = scalar(1),
                      .stiffness = scalar(kOmega * kOmega),
                      .beta = 2 * damping_ratio / kOmega,
                      .start = Vector::Ones(1),
                      .velocity_scale = 10 * kOmega});
}

std::string order(const std::string& method, double damping_ratio, const std::string& options) {
  const auto model = oscillator(damping_ratio);
  const auto choice =
      Registry<IntegratorChoice>::read(Config::from_text(fmt::format("{{type: {}, {}}}", method, options), "a.yaml"));
  const auto integrator =
      choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
  for (const auto& [key, value] : integrator->decisions())
    if (key == "max_order") return value;
  return "none";
}

TEST(DefaultOrder, IsHighWhereTheMotionIsWellDamped) {
  for (const std::string method : {"cvode_bdf", "ida_bdf"}) {
    EXPECT_EQ(order(method, 0, "rtol: 1e-4"), "2");
    EXPECT_EQ(order(method, 0.9e-3, "rtol: 1e-4"), "2");
    EXPECT_EQ(order(method, 1.1e-3, "rtol: 1e-4"), "5");
    EXPECT_EQ(order(method, 4e-3, "rtol: 1e-2"), "2");
    EXPECT_EQ(order(method, 6e-3, "rtol: 1e-2"), "5");
    EXPECT_EQ(order(method, 0, "rtol: 1e-4, max_order: 3"), "3");
  }
}

}  // namespace
}  // namespace orthodyn::default_order_test
