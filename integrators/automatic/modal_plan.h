// Whether `auto` takes `modal`: the lowest modes of a linear model in place of steps.
#pragma once

#include "integrators/automatic/cost_estimate.h"

namespace orthodyn {

// As many of the lowest modes as serve a run: a trial of it leaves out less than rtol of the displacement and ten times
// that of the velocity. None where the model is not linear, where its modes cannot serve (damping that couples them, an
// unstable state of rest, several ranks), where it takes too many of them, and where they would cost more than half of
// what `other`, the best method that takes steps, costs.
std::optional<MethodChoice> plan_modal(const Model& model, const Task& task, const CostEstimate& cost, double rtol,
                                       const MethodChoice& other);

}  // namespace orthodyn
