// The generalised-alpha method (Chung & Hulbert 1993). Its parameters damp slow oscillations least for a given damping
// of the fastest ones.
#include "integrators/native/alpha_method.h"

namespace orthodyn {
namespace {

AlphaParameters least_damping(double rho) {
  const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1), theta = alpha_m - alpha_f;
  return {alpha_m, alpha_f, 0.25 * (1 - theta) * (1 - theta), 0.5 - theta};
}

class GeneralizedAlphaChoice : public SettableChoice<GeneralizedAlphaChoice>, public NewtonOptions {
 public:
  double rho_inf = 0.8;

  static const Spec<GeneralizedAlphaChoice>& spec() {
    using C = GeneralizedAlphaChoice;
    static const auto s = NewtonOptions::spec_for<C>().key(
        "rho_inf", &C::rho_inf,
        "Amplitude of the fastest oscillations after a step, relative to before: 0 removes them, 1 keeps them.",
        {.range = {0, 1}});
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2", "A-stable; fast oscillations shrink to rho_inf per step", "momentum",
                        "Chung & Hulbert 1993; error estimate: Hulbert & Jang 1995");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<AlphaMethod>("generalized_alpha", model, *this, scales(task), least_damping(rho_inf));
  }
};

const bool generalized_alpha_registered = Registry<IntegratorChoice>::add<GeneralizedAlphaChoice>(
    "generalized_alpha",
    "The generalised-alpha method with adjustable damping of fast modes; adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn
