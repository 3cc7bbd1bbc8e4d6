// What a flag of KINSol says, with the key that may help.
#pragma once

#include <string>

#include "integrators/kinsol/kinsol.h"
#include "integrators/sundials/callbacks.h"

namespace orthodyn::sundials {

// context: of the callbacks that were called.
std::string failure_sentence(int flag, const KinsolOptions& options, bool stiffness_is_exact,
                             const CallbackContext& context);

}  // namespace orthodyn::sundials
