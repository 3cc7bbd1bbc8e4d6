#include "integrators/damping_ratio.h"

namespace orthodyn {

namespace {

// A position scale is about a tenth of the motion.
constexpr double kScaleOfMotion = 0.1;

// Measured numbers of steps with order 2 and with order 5, for a cantilever at rtol 1e-4: 1216 and 10150 at damping
// ratio 2.5e-4, 1186 and 3417 at 7.5e-4, 1062 and 1129 at 2.5e-3, 982 and 705 at 7.5e-3. At a loose tolerance and a
// damping ratio of 0.003, order 5 becomes inaccurate for a beam with a stiff part.
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
