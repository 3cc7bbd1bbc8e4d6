// The alpha method of Hilber, Hughes & Taylor (1977): Newmark's method with a weighted mean of the forces at both ends.
#include "integrators/native/alpha_method.h"

namespace orthodyn {
namespace {

class HhtAlphaChoice : public SettableChoice<HhtAlphaChoice>, public NewtonOptions {
 public:
  double alpha = -0.05;

  static const Spec<HhtAlphaChoice>& spec() {
    static const auto s = NewtonOptions::spec_for<HhtAlphaChoice>().key(
        "alpha", &HhtAlphaChoice::alpha, "Damping of fast oscillations: 0 none, -1/3 most.", {.range = {-1.0 / 3, 0}});
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2", "A-stable; fast oscillations shrink to (1 + alpha) / (1 - alpha) per step", "momentum",
                        "Hilber, Hughes & Taylor 1977; error estimate: Hulbert & Jang 1995");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    const AlphaParameters p{0, -alpha, 0.25 * (1 - alpha) * (1 - alpha), 0.5 - alpha};
    return std::make_unique<AlphaMethod>("hht_alpha", model, *this, scales(task), p);
  }
};

const bool hht_alpha_registered = Registry<IntegratorChoice>::add<HhtAlphaChoice>(
    "hht_alpha", "The alpha method of Hilber, Hughes & Taylor; adaptive or with a fixed step, implicit.");

}  // namespace
}  // namespace orthodyn
