// A run by modes for the sake of what it leaves out; the integrator itself is made by its name, `modal`.
#pragma once

#include <optional>

#include "lib/ode/integrator.h"

namespace orthodyn {

// Of the largest displacement and the largest velocity, as ModalTruncation has them.
struct ModalShares {
  double displacement = 0, velocity = 0;
};

// Runs `task` with so many modes, without outputs. None if that takes more than so many forces. Throws what the
// integrator throws: ConfigError, RunError, RecoverableError.
std::optional<ModalShares> try_modal(const Model& model, const Task& task, int modes, double rtol, long most_forces);

}  // namespace orthodyn
