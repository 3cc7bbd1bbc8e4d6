// Decides whether `auto` chooses `modal` for a linear model.
#pragma once

#include "integrators/automatic/cost_estimate.h"
#include "integrators/error_control.h"

namespace orthodyn {

// True if the model is linear, symmetric and on one process, as `modal` requires.
bool allows_modes(const Model& model);

// Returns `modal` with the first number of modes (20, 40, 80, ...) with which a trial run leaves out at most rtol of
// the displacement and 10 rtol of the velocity. Returns nothing if
//   allows_modes() is false, the force is not f(t, 0, 0) - K q - D v, or the linear solver is iterative;
//   the modes cannot be used (damping couples them, or the model is unstable at rest), or a trial run fails;
//   a model of n > 100 unknowns needs more than min(640, n / 5, 2e7 / n) modes;
//   computing the modes, the trials and the run would cost more than half of `other.cost`.
// Precondition: `other` is the best time-stepping method, with its estimated cost.
std::optional<MethodChoice> plan_modal(const Model& model, const Task& task, const CostEstimate& cost,
                                       const ErrorControl& control, const MethodChoice& other);

}  // namespace orthodyn
