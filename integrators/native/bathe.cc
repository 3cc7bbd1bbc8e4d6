// Bathe's method, whose parameter is the spectral radius for infinitely fast oscillations (Noh & Bathe 2019).
#include "integrators/native/dirk.h"

namespace orthodyn {
namespace {

class BatheChoice : public SettableChoice<BatheChoice>, public NewtonOptions {
 public:
  double rho_inf = 0, splitting = 0.5;

  static const Spec<BatheChoice>& spec() {
    using C = BatheChoice;
    static const auto s =
        NewtonOptions::spec_for<C>()
            .key(
                "rho_inf", &C::rho_inf,
                "Amplitude of the fastest oscillations after a step, relative to before: 0 removes them, 1 keeps them.",
                {.range = {0, 1}})
            .key("splitting", &C::splitting, "End of the trapezoidal part, as a fraction of the step.",
                 {.range = {0.01, 0.99}});
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2", "A-stable; fast oscillations shrink to rho_inf per step",
                        "momentum; with rho_inf = 1 the energy of linear models",
                        "Noh & Bathe 2019; error estimate: Hosea & Shampine 1996");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    const double g = splitting, q1 = (rho_inf + 1) / (2 * g * (rho_inf - 1) + 4);
    return std::make_unique<Dirk>("bathe", model, *this, scales(task), composite_table(g, q1, 0.5 - g * q1));
  }
};

const bool bathe_registered = Registry<IntegratorChoice>::add<BatheChoice>(
    "bathe", "Bathe's method of two substeps with adjustable damping of fast modes; adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn
