// What a run that was expected to show certain figures is worth.
#pragma once

#include <optional>
#include <string>

#include "lib/study/quantities/verify.h"

namespace orthodyn {

enum class Grade { pass, degraded, fail };

struct Verdict {
  Grade grade = Grade::fail;
  std::optional<Check> worst;  // the figure that is farthest from what was expected; none if the run did not end
  std::string reason;          // of what is no pass, in a few words
};

const char* grade_word(Grade grade);  // "pass"

// A run passes if all its figures are within their tolerances, is degraded if none is off by more than its `degraded`
// tolerances, and fails otherwise or if it did not come to its end. Precondition: it has checks.
Verdict judge(const CaseResult& result);

}  // namespace orthodyn
