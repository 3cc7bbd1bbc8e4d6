// A state beyond a limit of the input.
#pragma once

#include "lib/core/errors.h"

namespace orthodyn {

// what() tells the limit and the remedy: solvers that give up add no advice of their own (Cause).
class LimitError : public RecoverableError {
 public:
  using RecoverableError::RecoverableError;
};

}  // namespace orthodyn
