// How a run did that was expected to show certain metrics.
#pragma once

#include <optional>
#include <string>

#include "lib/study/quantities/verify.h"

namespace orthodyn::study::stability {

enum class Grade { pass, degraded, fail };

struct CaseGrade {
  Grade grade = Grade::fail;
  std::optional<Check> worst;  // the metric that is farthest from what was expected; none if the run did not end
  std::string reason;          // of what is no pass, in a few words
};

const char* grade_word(Grade grade);  // "pass"

// A run passes if all its metrics are within their tolerances, is degraded if none is off by more than its `degraded`
// tolerances, and fails otherwise or if it did not come to its end. Precondition: it has checks.
CaseGrade grade(const CaseResult& result);

}  // namespace orthodyn::study::stability
