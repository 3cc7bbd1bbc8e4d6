#include "integrators/sundials/bdf_order.h"

#include "integrators/damping_ratio.h"
#include "lib/core/errors.h"

namespace orthodyn::sundials {

int bdf_order(const std::optional<int>& given, const Model& model, const Task& task, double rtol,
              const Scales& scales) {
  if (given) return *given;
  if (model.traits().rigid && model.traits().smooth) return 5;
  if (!model.traits().damped) return 2;
  Statistics unused;
  CriticalStep critical(model, unused);
  try {
    critical.at_present(task.initial);
    return suits_high_orders(damping_ratio_of_motion(model, task, critical, scales), rtol) ? 5 : 2;
  } catch (const RecoverableError&) {  // Integrator::start() reports the error
    return 2;
  }
}

}  // namespace orthodyn::sundials
