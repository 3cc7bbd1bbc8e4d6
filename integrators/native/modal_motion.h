// The motion of the modes of a basis: their coordinates, at rest and after a time under the load of a step.
#pragma once

#include "integrators/native/modal_load.h"

namespace orthodyn {

struct ModalState {
  Vector r, rate;
};

// Of the modes that represent a state best, in the mass norm.
ModalState modal_state(const ModalBasis& basis, const State& state);

// A time tau after the begin of the step, s.
ModalState modal_state_after(const ModalBasis& basis, const ModalState& begin, const StepLoad& load, double tau);

// Coordinates at rest under the load phi' f; zero for modes without stiffness.
Vector modal_equilibrium(const ModalBasis& basis, const Vector& modal);

}  // namespace orthodyn
