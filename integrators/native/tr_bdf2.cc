// TR-BDF2 (Bank et al. 1985): the trapezoidal rule over the fraction g of the step, then BDF2. With g = 2 - sqrt 2 both
// parts share one matrix (Hosea & Shampine 1996).
#include <numbers>

#include "integrators/native/dirk.h"

namespace orthodyn {
namespace {

DirkTable tr_bdf2() {
  const double g = 2 - std::numbers::sqrt2;
  return composite_table(g, std::numbers::sqrt2 / 4, g / 2);
}

class TrBdf2Choice : public SettableChoice<TrBdf2Choice>, public NewtonOptions {
 public:
  static const Spec<TrBdf2Choice>& spec() {
    static const auto s = NewtonOptions::spec_for<TrBdf2Choice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2", "L-stable", "momentum",
                        "Bank et al. 1985; Hosea & Shampine 1996, also the error estimate");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<Dirk>("tr_bdf2", model, *this, scales(task), tr_bdf2());
  }
};

const bool tr_bdf2_registered = Registry<IntegratorChoice>::add<TrBdf2Choice>(
    "tr_bdf2", "TR-BDF2: trapezoidal rule and BDF2 in one step, with one matrix; adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn
