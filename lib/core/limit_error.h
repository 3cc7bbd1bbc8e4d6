// A state beyond a limit of the input.
#pragma once

#include <string>

#include "lib/core/errors.h"

namespace orthodyn {

// what() is "place: message" with the limit and the remedy: solvers that give up add no advice of their own (Cause).
class LimitError : public RecoverableError {
 public:
  LimitError(const std::string& place, const std::string& message)
      : RecoverableError(place + ": " + message), place_(place), message_(message) {}

  const std::string& place() const { return place_; }  // in the input
  const std::string& message() const { return message_; }

 private:
  std::string place_, message_;
};

}  // namespace orthodyn
