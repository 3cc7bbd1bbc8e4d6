// For tests of messages: the error that an action throws, and searches in its text.
#pragma once

#include <gtest/gtest.h>

#include <concepts>
#include <string>

#include "lib/core/errors.h"

namespace orthodyn {

// The message of the ConfigError that `action` throws, or "accepted".
template <std::invocable Action>
std::string refusal(Action&& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

inline testing::AssertionResult holds(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

inline testing::AssertionResult starts(const std::string& text, const std::string& part) {
  if (text.rfind(part, 0) == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "not at the start: '" << part << "' of: " << text;
}

}  // namespace orthodyn
