#include "integrators/damping_ratio.h"

namespace orthodyn {

namespace {

// A position scale, against which errors are measured, is about a tenth of the motion.
constexpr double kScaleOfMotion = 0.1;

// cantilever at rtol 1e-4, steps with order 2 and 5: 1216 and 10150 at 2.5e-4, 1186 and 3417 at 7.5e-4, 1062 and 1129
// at 2.5e-3, 982 and 705 at 7.5e-3. At a loose tolerance order 5 loses its way on a stiff part of a beam at 0.003.
constexpr double kWellDamped = 1e-3, kWellDampedIfLoose = 5e-3, kLoose = 5e-3;

}  // namespace

double frequency_of_motion(const Scales& scales) { return kScaleOfMotion * scales.velocity / scales.position; }

double damping_ratio_of_motion(const CriticalStep& critical, const Scales& scales) {
  return critical.damping_time() * frequency_of_motion(scales) / 2;
}

bool suits_high_orders(double damping_ratio, double rtol) {
  return damping_ratio > (rtol < kLoose ? kWellDamped : kWellDampedIfLoose);
}

}  // namespace orthodyn
