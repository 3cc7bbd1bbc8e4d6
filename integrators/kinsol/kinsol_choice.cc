// The equilibrium solver `kinsol` and its keys.
#include "integrators/kinsol/kinsol.h"
#include "integrators/solver_options.h"
#include "lib/linear/solver.h"
#include "lib/ode/integrator.h"

namespace orthodyn::sundials {
namespace {

class KinsolChoice : public EquilibriumChoice, public KinsolOptions {
 public:
  static const Spec<KinsolChoice>& spec() {
    using C = KinsolChoice;
    static const auto s = [] {
      auto spec =
          Spec<C>()
              .key("rtol", &C::rtol, "Largest residual, relative to the largest load on a coordinate.",
                   {.range = {1e-15, 1e-2}})
              .key("max_iterations", &C::max_iterations, "Newton iterations per load step.", {.range = {1, 10'000}});
      add_linear_solver(spec, SolverPaths::reduced);
      return spec;
    }();
    return s;
  }
  static MethodFacts facts() {
    return {{"source",
             "Hindmarsh et al., ACM TOMS 31, 2005; Riks, Int. J. Solids Struct. 15, 1979; Magisano, Leonetti & Garcea, "
             "CMAME 313, 2017"}};
  }
  bool takes_unsymmetric() const override { return solver_registry().at(linear_solver.type).takes_general; }
  std::unique_ptr<EquilibriumSolver> make(const LoadPath& path, const EquilibriumTask& task) const override {
    return make_kinsol(path, task, *this);
  }
};

const bool kinsol_registered =
    Registry<EquilibriumChoice>::add<KinsolChoice>("kinsol",
                                                   "KINSOL: Newton's method with stresses as independent unknowns, "
                                                   "which allows long load steps of slender bodies; one "
                                                   "factorisation per iteration.");

}  // namespace
}  // namespace orthodyn::sundials
