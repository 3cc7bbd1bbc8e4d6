// Singly diagonally implicit Runge-Kutta methods, stiffly accurate and L-stable. All stages share one matrix.
// Order 2 and 3: Alexander (1977); order 4: Hairer & Wanner (1996), table IV.6.5.
#include <cmath>

#include "integrators/native/dirk.h"

namespace orthodyn {
namespace {

// The error estimate is the J^2 f term of the local error (the complete error for linear models without loads), from
// the second divided difference of the slopes at 0, g and 1.
DirkTable order_2() {
  const double g = 1 - std::sqrt(0.5);
  const double missing = 1.0 / 6 - g * g * (3 - 2 * g);  // 1/6 - b A c
  const double scale = missing / g;                      // the divided difference d satisfies d A c = g
  return {2, 3, {0, g, 1}, {{0, g}, {0, 1 - g, g}}, {scale / g, -scale / (g * (1 - g)), scale / (1 - g)}};
}

// The embedded rule of order 2 uses the first two stages.
DirkTable order_3() {
  const double g = 0.435866521508458999416019;
  const double b1 = -(6 * g * g - 16 * g + 1) / 4, b2 = (6 * g * g - 20 * g + 5) / 4;
  const double w2 = (1 - 2 * g) / (1 - g), w1 = 1 - w2;
  return {3, 3, {0, g, (1 + g) / 2, 1}, {{0, g}, {0, (1 - g) / 2, g}, {0, b1, b2, g}}, {0, w1 - b1, w2 - b2, -g}};
}

DirkTable order_4() {
  const double b1 = 25.0 / 24, b2 = -49.0 / 48, b3 = 125.0 / 16, b4 = -85.0 / 12, g = 0.25;
  return {4,
          4,
          {0, 0.25, 0.75, 0.55, 0.5, 1},
          {{0, g},
           {0, 0.5, g},
           {0, 17.0 / 50, -1.0 / 25, g},
           {0, 371.0 / 1360, -137.0 / 2720, 15.0 / 544, g},
           {0, b1, b2, b3, b4, g}},
          {0, 59.0 / 48 - b1, -17.0 / 96 - b2, 225.0 / 32 - b3, 0, -g}};
}

class SdirkChoice : public SettableChoice<SdirkChoice>, public NewtonOptions {
 public:
  int order = 3;

  static const Spec<SdirkChoice>& spec() {
    using C = SdirkChoice;
    static const auto s =
        NewtonOptions::spec_for<C>().key("order", &C::order, "Order 2, 3 or 4: 2, 3 or 5 stages.", {.range = {2, 4}});
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2-4, by `order`", "L-stable, stiffly accurate", "momentum",
                        "Alexander 1977; Hairer & Wanner 1996, IV.6; error estimates: embedded rules");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    const auto table = order == 2 ? order_2() : order == 3 ? order_3() : order_4();
    return std::make_unique<Dirk>("sdirk", model, *this, scales(task), table);
  }
};

const bool sdirk_registered = Registry<IntegratorChoice>::add<SdirkChoice>(
    "sdirk", "Singly diagonally implicit Runge-Kutta methods of order 2-4; adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn
