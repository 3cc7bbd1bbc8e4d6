// Backward Euler: v1 = v0 + h a1, q1 = q0 + h v1.
#include "integrators/native/dirk.h"

namespace orthodyn {
namespace {

// The error estimate is the difference from the trapezoidal rule: h/2 times the difference of the slopes at both ends.
DirkTable backward_euler() { return {1, 2, {0, 1}, {{0, 1}}, {0.5, -0.5}}; }

class BackwardEulerChoice : public SettableChoice<BackwardEulerChoice>, public NewtonOptions {
 public:
  static const Spec<BackwardEulerChoice>& spec() {
    static const auto s = NewtonOptions::spec_for<BackwardEulerChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1", "L-stable; damps every oscillation", "momentum",
                        "Hairer & Wanner 1996, IV; error estimate: difference to the trapezoidal rule");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<Dirk>("backward_euler", model, *this, scales(task), backward_euler());
  }
};

const bool backward_euler_registered = Registry<IntegratorChoice>::add<BackwardEulerChoice>(
    "backward_euler", "Backward Euler with Newton's method; adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn
