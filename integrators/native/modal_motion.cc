#include "integrators/native/modal_motion.h"

namespace orthodyn {

ModalState modal_state(const ModalBasis& basis, const State& state) {
  return {basis.coordinates(state.q), basis.coordinates(state.v)};
}

ModalState modal_state_after(const ModalBasis& basis, const ModalState& begin, const StepLoad& load, double tau) {
  ModalState now{Vector(basis.size()), Vector(basis.size())};
  for (Eigen::Index k = 0; k < basis.size(); ++k) {
    const Oscillation o = oscillate(basis.damping()[k], basis.lambda()[k], {begin.r[k], begin.rate[k]},
                                    load.modal.row(k).transpose(), load.h, tau);
    now.r[k] = o.r;
    now.rate[k] = o.rate;
  }
  return now;
}

Vector modal_equilibrium(const ModalBasis& basis, const Vector& modal) {
  Vector at_rest = modal;
  for (Eigen::Index k = 0; k < at_rest.size(); ++k)
    at_rest[k] = basis.lambda()[k] > 0 ? modal[k] / basis.lambda()[k] : 0;
  return at_rest;
}

}  // namespace orthodyn
