#include "lib/study/stability/case_grade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace orthodyn::study::stability {

namespace {

// A metric that is no number is as far off as can be.
double tolerances_off(const Check& check) {
  const double off = std::abs(check.difference()) / check.expectation.limit();
  return std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
}

Grade grade_of(const Check& check) {
  if (check.passed()) return Grade::pass;
  return tolerances_off(check) <= check.expectation.degraded ? Grade::degraded : Grade::fail;
}

bool is_better(const Check& a, const Check& b) {
  return std::pair(grade_of(a), tolerances_off(a)) < std::pair(grade_of(b), tolerances_off(b));
}

std::string describe(const Check& check) {
  if (check.expectation.take == Take::onset && std::isnan(check.computed))
    return fmt::format("{} never came, expected {:.3g} +- {:.2g}", check.expectation.title(),
                       check.expectation.value.si(), check.expectation.limit());
  return fmt::format("{} is {:.3g}, expected {:.3g} +- {:.2g}", check.expectation.title(), check.computed,
                     check.expectation.value.si(), check.expectation.limit());
}

}  // namespace

const char* grade_word(Grade grade) {
  switch (grade) {
    case Grade::pass: return "pass";
    case Grade::degraded: return "degraded";
    case Grade::fail: break;
  }
  return "fail";
}

CaseGrade grade(const CaseResult& result) {
  if (!result.completed()) return {Grade::fail, {}, result.outcome.message};
  const auto worst = std::max_element(result.checks.begin(), result.checks.end(), is_better);
  const Grade found = grade_of(*worst);
  return {found, *worst, found == Grade::pass ? "" : describe(*worst)};
}

}  // namespace orthodyn::study::stability
