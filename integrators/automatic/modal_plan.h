// Decides whether `auto` chooses `modal` for a linear model.
#pragma once

#include "integrators/automatic/cost_estimate.h"
#include "integrators/error_control.h"

namespace orthodyn {

// True if `modal` can integrate the model: it is linear, symmetric and held by one process.
bool allows_modes(const Model& model);

// Returns `modal` with the first number of modes (20, 40, 80, ...) with which a trial run leaves out at most rtol of
// the displacement and 10 rtol of the velocity. Returns nothing if
//   the model does not allow modes, its force is not f(t, 0, 0) - K q - D v, or the linear solver is iterative;
//   its modes cannot be used, because damping couples them or the state of rest is unstable;
//   more than 640 modes, or a fifth of more than 100 unknowns, would be needed;
//   computing the modes, the trials and the run would cost more than half of `other.cost`.
// Precondition: `other` is the best time-stepping method, with its estimated cost.
std::optional<MethodChoice> plan_modal(const Model& model, const Task& task, const CostEstimate& cost,
                                       const ErrorControl& control, const MethodChoice& other);

}  // namespace orthodyn
