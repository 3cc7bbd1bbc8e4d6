// CVODE's BDF (Hindmarsh et al. 2005): variable order 1-5, variable step, modified Newton. With constraints, the
// equations of index 1 are solved, and each step is projected (constraint_projection.h).
#include <cvodes/cvodes.h>

#include "integrators/cvode/cvode.h"
#include "integrators/sundials/bdf_order.h"

namespace orthodyn::sundials {
namespace {

class CvodeBdfChoice : public SettableChoice<CvodeBdfChoice>,
                       public Options,
                       public SensitivityOptions,
                       public AdjointIntegrator {
 public:
  static const Spec<CvodeBdfChoice>& spec() {
    static const auto s = bdf_spec<CvodeBdfChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-5, variable", "A-stable and damping at order 1-2, A(alpha) at 3-5 (alpha 86 to 51 degrees)",
                        "linear invariants (momentum); energy of oscillations is damped",
                        "Hindmarsh et al., ACM TOMS 31, 2005; Curtiss & Hirschfelder 1952");
  }
  bool runs_on_ranks() const override { return true; }
  bool computes_sensitivities() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::own; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    const Scales sizes = scales(task);
    const int order = bdf_order(max_order, model, task, rtol, sizes);
    const CvodeMethod method{
        .name = "cvode_bdf", .family = CV_BDF, .max_order = order, .simultaneous = is_simultaneous()};
    return make_cvode(method, model, *this, sizes, task.sensitivities);
  }
  AdjointSolution integrate_adjoint(const Model& model, const Task& task, AdjointEquations& equations) const override {
    if (model.constraints())
      throw ConfigError("derivatives of motions are not available with joints or free rigid bodies; remove them");
    const Scales sizes = scales(task);
    const int order = bdf_order(max_order, model, task, rtol, sizes);
    return integrate_cvode_adjoint({"cvode_bdf", CV_BDF, order}, model, *this, sizes, task, equations);
  }

  std::optional<int> max_order;
};

const bool cvode_bdf_registered = Registry<IntegratorChoice>::add<CvodeBdfChoice>(
    "cvode_bdf", "CVODE: backward differentiation formulas of order 1-5, adaptive, implicit.");

}  // namespace
}  // namespace orthodyn::sundials
