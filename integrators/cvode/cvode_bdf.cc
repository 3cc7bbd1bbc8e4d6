// CVODE's BDF (Hindmarsh et al. 2005): variable order 1-5, variable step, modified Newton.
#include <cvode/cvode.h>

#include "integrators/cvode/cvode.h"
#include "integrators/sundials/multistep.h"

namespace orthodyn::sundials {
namespace {

class CvodeBdf : public Cvode {
 public:
  CvodeBdf(const Model& model, const MultistepSettings& settings)
      : Cvode("cvode_bdf", model, settings, CV_BDF, settings.max_order) {}

 private:
  void choose_iteration() override { attach_newton(); }
};

class CvodeBdfChoice : public SettableChoice<CvodeBdfChoice>, public MultistepOptions {
 public:
  static const Spec<CvodeBdfChoice>& spec() {
    static const auto s = MultistepOptions::spec_for<CvodeBdfChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-5, variable", "A-stable and damping at order 1-2, A(alpha) at 3-5 (alpha 86 to 51 degrees)",
                        "linear invariants (momentum); energy of oscillations is damped",
                        "Hindmarsh et al., ACM TOMS 31, 2005; Curtiss & Hirschfelder 1952");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<CvodeBdf>(model, MultistepSettings::complete(*this, model, task));
  }
};

const bool cvode_bdf_registered = Registry<IntegratorChoice>::add<CvodeBdfChoice>(
    "cvode_bdf", "CVODE: backward differentiation formulas of order 1-5, adaptive, implicit.");

}  // namespace
}  // namespace orthodyn::sundials
