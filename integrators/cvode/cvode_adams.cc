// CVODE's Adams-Moulton methods (Hindmarsh et al. 2005): variable order 1-12, variable step. For smooth,
// lightly damped motion at tight tolerances; high orders are stable for short steps only.
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrators/cvode/cvode.h"

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

struct AdamsOptions : Options {
  StepIteration nonlinear = StepIteration::newton;
  int anderson = 0;
  int max_order = 12;
};

Settings complete(const AdamsOptions& options, const Task& task) {
  Settings settings = Settings::complete(options, task);
  settings.implicit = options.nonlinear == StepIteration::newton;
  return settings;
}

class CvodeAdams : public Cvode {
 public:
  CvodeAdams(const Model& model, const AdamsOptions& options, const Task& task)
      : Cvode("cvode_adams", model, complete(options, task), CV_ADAMS, options.max_order),
        anderson_(options.anderson) {}

 private:
  void choose_iteration() override {
    if (settings_.implicit) {
      attach_newton();
      return;
    }
    fixed_point_.reset(SUNNonlinSol_FixedPoint(y(), anderson_, context_));
    if (!fixed_point_) throw RunError("SUNDIALS could not create its fixed-point iteration", Reason::out_of_memory);
    require(CVodeSetNonlinearSolver(memory(), fixed_point_.get()));
  }

  std::string iteration_failure() const override {
    if (settings_.implicit) return Cvode::iteration_failure();
    return "the fixed-point iteration does not converge at the smallest step" + cause() +
           "; set integrator.nonlinear: newton, or lower h_min";
  }

  int anderson_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> fixed_point_;
};

void refuse_newton_keys(const AdamsOptions& options, const Config& config) {
  const AdamsOptions usual;
  const bool newton = options.nonlinear == StepIteration::newton;
  if (newton && options.anderson > 0) config.at("anderson").fail("has no meaning with nonlinear: newton; remove it");
  if (!newton && options.linear_solver != usual.linear_solver)
    config.at("linear_solver").fail("has no meaning with nonlinear: fixed_point; remove it");
  if (!newton && options.gauss_newton)
    config.at("gauss_newton").fail("has no meaning with nonlinear: fixed_point; remove it");
}

class CvodeAdamsChoice : public SettableChoice<CvodeAdamsChoice>, public AdamsOptions {
 public:
  static const Spec<CvodeAdamsChoice>& spec() {
    using C = CvodeAdamsChoice;
    static const auto s =
        Options::spec_for<C>()
            .key("max_order", &C::max_order, "Highest order.", {.range = {1, 12}})
            .key("nonlinear", &C::nonlinear,
                 "How a step is solved: Newton's method, or fixed-point iteration, which needs no matrix and steps "
                 "below one over the highest frequency.")
            .key("anderson", &C::anderson,
                 "Earlier iterates that accelerate the fixed-point iteration (Anderson 1965).", {.range = {0, 10}})
            .check(refuse_newton_keys);
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-12, variable", "A-stable at order 1-2, bounded step above (stiff parts force short steps)",
                        "linear invariants (momentum)", "Hindmarsh et al., ACM TOMS 31, 2005; Byrne & Hindmarsh 1975");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<CvodeAdams>(model, *this, task);
  }
};

const bool cvode_adams_registered = Registry<IntegratorChoice>::add<CvodeAdamsChoice>(
    "cvode_adams", "CVODE: Adams-Moulton methods of order 1-12, adaptive; for smooth, lightly damped motion.");

}  // namespace
}  // namespace sundials
}  // namespace orthodyn
