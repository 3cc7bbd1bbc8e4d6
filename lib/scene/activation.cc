#include "lib/scene/activation.h"

namespace orthodyn {

const Spec<Activation>& Activation::spec() {
  static const auto s =
      Spec<Activation>()
          .key("value", &Activation::change, "Activation from 0 to 1: a number, or a formula of x, y, z.")
          .key("factor", &Activation::factor, "Factor of `value` or `file` in time.", {.fallback = "{type: constant}"})
          .key("formula", &Activation::formula, "Instead of `value` and `factor`: a formula of t, x, y, z.")
          .key("kinks", &Activation::kinks, "Times at which `formula` is not smooth; integrators restart there.",
               {.unit = "s"})
          .key("file", &Activation::file,
               "Instead of `value`: a CSV file with the columns node (from 0) and value, for all nodes of the mesh.")
          .check([](const Activation& activation, const Config& config) { activation.check(config); });
  return s;
}

}  // namespace orthodyn
