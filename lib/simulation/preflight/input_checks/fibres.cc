// Active fibres whose tension falls with the stretch, on the descending limb of the force-length factor, faster than
// the matrix can resist.

#include "lib/material/fibres/fibres.h"

#include <optional>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

struct Stretches {
  double first, last;
};

// The stretches beyond 1 at which a nearly incompressible isotropic matrix of the shear modulus G (Pa) with these
// fibres is not elliptic: T' < 0 and T'^2 > 4 G (|T'| + T/lambda), for the tension T at full activation
// (docs/fibres.md).
std::optional<Stretches> unstable_stretches(const Fibres& fibres, double G) {
  constexpr double kLargest = 2, kStep = 0.005;
  const auto active = fibres.active->length->factor();
  const auto passive = fibres.passive ? fibres.passive->stress() : nullptr;
  std::optional<Stretches> found;
  for (double x = 0; x <= kLargest - 1; x += kStep) {
    const double peak = fibres.active->stress, tension = peak * active->value(x) + (passive ? passive->value(x) : 0);
    const double slope = peak * active->slope(x) + (passive ? passive->slope(x) : 0);
    if (slope >= 0 || slope * slope <= 4 * G * (-slope + tension / (1 + x))) continue;
    if (!found) found = Stretches{1 + x, 1 + x};
    found->last = 1 + x;
  }
  return found;
}

}  // namespace

void check_fibres(const CheckContext& context, Warnings& out) {
  for (const auto& [name, material] : context.scene.materials) {
    if (!material->fibres() || !material->fibres()->active) continue;
    const Mat6 C = voigt(material->stiffness());
    const double G = std::min(C(3, 3), C(5, 5));
    if (const auto found = unstable_stretches(*material->fibres(), G))
      warn(out, context.config.at("materials").at(name).at("fibres").where(),
           "at full activation and stretches from {:.3g} to {:.3g}, the tension of the fibres falls faster than the "
           "matrix resists (shear modulus {:.3g} Pa): a body that is stretched so far splits into bands of long and "
           "short fibres, each an element wide. Add `passive` tension, or keep the stretch below {:.3g}",
           found->first, found->last, G, found->first);
  }
}

}  // namespace orthodyn::input_checks
