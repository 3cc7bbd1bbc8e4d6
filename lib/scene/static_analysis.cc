#include "lib/scene/static_analysis.h"

namespace orthodyn {

const Spec<Statics>& Statics::spec() {
  static const auto s = LoadStepping::spec_for<Statics>().key(
      "solver", &Statics::solver, "Finds the equilibrium of each load step.", {.fallback = "{type: kinsol}"});
  return s;
}

}  // namespace orthodyn
