// Why a model could not be evaluated, for the message of a solver that gives up.
#pragma once

#include <string>

#include "lib/core/limit_error.h"

namespace orthodyn {

// The message of a RecoverableError; empty before note().
class Cause {
 public:
  void clear() { *this = {}; }
  void note(const RecoverableError& error) {
    is_limit_ = dynamic_cast<const LimitError*>(&error) != nullptr;
    text_ = error.what();
  }

  bool empty() const { return text_.empty(); }
  // Of a LimitError.
  bool is_limit() const { return is_limit_; }
  const std::string& text() const { return text_; }
  // " (text)", or "" if empty.
  std::string in_brackets() const { return empty() ? "" : " (" + text_ + ")"; }
  // "problem (text)advice", or the text alone if it is that of a LimitError.
  std::string explain(const std::string& problem, const std::string& advice) const {
    return is_limit_ ? text_ : problem + in_brackets() + advice;
  }

 private:
  std::string text_;
  bool is_limit_ = false;
};

}  // namespace orthodyn
