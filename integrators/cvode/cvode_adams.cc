// CVODE's Adams-Moulton methods (Hindmarsh et al. 2005): variable order 1-12, variable step. For smooth, lightly damped
// motion at tight tolerances; high orders are stable only for short steps.
#include <cvodes/cvodes.h>

#include "integrators/cvode/cvode.h"
#include "integrators/sundials/sensitivity_corrector.h"

namespace orthodyn {

// How the equation of a step is solved.
enum class StepIteration { fixed_point, newton };

template <>
struct EnumNames<StepIteration> {
  static constexpr std::array<std::pair<StepIteration, const char*>, 2> list{
      {{StepIteration::fixed_point, "fixed_point"}, {StepIteration::newton, "newton"}}};
};

namespace sundials {
namespace {

class CvodeAdamsChoice : public SettableChoice<CvodeAdamsChoice>, public Options, public SensitivityOptions {
 public:
  static const Spec<CvodeAdamsChoice>& spec() {
    using C = CvodeAdamsChoice;
    static const auto s = [] {
      auto spec = Options::spec_for<C>();
      spec.key("max_order", &C::max_order, "Highest order.", {.range = {1, 12}})
          .key("nonlinear", &C::nonlinear,
               "Solver of a step: Newton's method, or fixed-point iteration, which needs no matrix, but needs steps "
               "below 1/omega_max.")
          .key("anderson", &C::anderson,
               "Number of earlier iterates used to accelerate the fixed-point iteration (Anderson 1965).",
               {.range = {0, 10}})
          .check([](const C& options, const Config& config) { options.check_iteration_keys(config); });
      return SensitivityOptions::add_to(spec);
    }();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-12, variable", "A-stable at order 1-2; at higher orders stiff parts force short steps",
                        "linear invariants (momentum)", "Hindmarsh et al., ACM TOMS 31, 2005; Byrne & Hindmarsh 1975");
  }
  bool runs_on_ranks() const override { return true; }
  bool computes_sensitivities() const override { return nonlinear == StepIteration::newton; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    CvodeMethod method{
        .name = "cvode_adams", .family = CV_ADAMS, .max_order = max_order, .simultaneous = is_simultaneous()};
    if (nonlinear == StepIteration::fixed_point) method.anderson = anderson;
    return make_cvode(method, model, *this, scales(task), task.sensitivities);
  }

  StepIteration nonlinear = StepIteration::newton;
  int anderson = 0;
  int max_order = 12;

 private:
  void check_iteration_keys(const Config& config) const {
    if (nonlinear == StepIteration::newton) {
      if (anderson > 0) config.at("anderson").fail("is not used with nonlinear: newton; remove it");
      return;
    }
    if (linear_solver != Options().linear_solver)
      config.at("linear_solver").fail("is not used with nonlinear: fixed_point; remove it");
    if (gauss_newton) config.at("gauss_newton").fail("is not used with nonlinear: fixed_point; remove it");
    if (is_simultaneous())
      config.at("sensitivity_corrector").fail("is not used with nonlinear: fixed_point; remove it");
  }
};

const bool cvode_adams_registered = Registry<IntegratorChoice>::add<CvodeAdamsChoice>(
    "cvode_adams", "CVODE: Adams-Moulton methods of order 1-12, adaptive; for smooth, lightly damped motion.");

}  // namespace
}  // namespace sundials
}  // namespace orthodyn
