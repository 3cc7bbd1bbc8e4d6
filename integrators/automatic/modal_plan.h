// Whether `auto` takes `modal`: the lowest modes of a linear model in place of steps.
#pragma once

#include "integrators/automatic/cost_estimate.h"
#include "integrators/error_control.h"

namespace orthodyn {

// Whether `modal` could integrate the model at all: it is linear and symmetric, and one process holds it.
bool allows_modes(const Model& model);

// `modal` with as many of the lowest modes as a trial run asks for: what they leave out is below rtol of the
// displacement and below ten times rtol of the velocity. None where the model does not allow modes, where its force is
// not f(t, 0, 0) - K q - D v, where its modes cannot serve (damping that couples them, an unstable state of rest),
// where hundreds would be needed, and where modes, trials and run would cost more than half of `other.cost`.
// Precondition: `other` is the best method that takes steps, with its cost.
std::optional<MethodChoice> plan_modal(const Model& model, const Task& task, const CostEstimate& cost,
                                       const ErrorControl& control, const MethodChoice& other);

}  // namespace orthodyn
