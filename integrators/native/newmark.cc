// Newmark's method (Newmark 1959). The defaults give the trapezoidal rule (constant average acceleration).
#include "integrators/native/alpha_method.h"

namespace orthodyn {
namespace {

class NewmarkChoice : public SettableChoice<NewmarkChoice>, public NewtonOptions {
 public:
  double beta = 0.25, gamma = 0.5;

  static const Spec<NewmarkChoice>& spec() {
    using C = NewmarkChoice;
    static const auto s =
        NewtonOptions::spec_for<C>()
            .key("beta", &C::beta, "Weight of the new acceleration in positions.", {.range = {0, 1, true, false}})
            .key("gamma", &C::gamma, "Weight of the new acceleration in velocities; above 1/2 it damps.",
                 {.range = {0.5, 1}})
            .check([](const C& c, const Config& config) {
              if (2 * c.beta < c.gamma)
                config.at("beta").fail("must be at least gamma / 2 = " + number_text(c.gamma / 2) +
                                       "; with smaller values, stiff modes grow");
            });
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2 for gamma = 1/2, else 1", "A-stable for 2 beta >= gamma; does not damp with gamma = 1/2",
                        "momentum; with the defaults the energy of linear models",
                        "Newmark 1959; error estimate: Zienkiewicz & Xie 1991");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<AlphaMethod>("newmark", model, *this, scales(task), AlphaParameters{0, 0, beta, gamma});
  }
};

const bool newmark_registered = Registry<IntegratorChoice>::add<NewmarkChoice>(
    "newmark", "Newmark's method, by default the trapezoidal rule; adaptive or with a fixed step, implicit.");

}  // namespace
}  // namespace orthodyn
