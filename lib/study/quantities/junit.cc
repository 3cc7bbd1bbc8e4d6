// Results of `orthodyn verify` as JUnit XML, for continuous integration.
#include <fmt/format.h>

#include "lib/study/quantities/verify.h"

namespace orthodyn::study {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string test_case(const CaseResult& result, const Check& check) {
  const auto& e = check.expectation;
  std::string out =
      fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", escaped(result.file), escaped(e.title()),
                  result.outcome.wall_seconds / static_cast<double>(result.checks.size()));
  if (!result.completed())
    return out + fmt::format(">\n    <error message=\"{}\"/>\n  </testcase>\n", escaped(result.outcome.message));
  if (check.passed()) return out + "/>\n";
  return out + fmt::format(
                   ">\n    <failure message=\"computed {:.9g}, expected {:.9g}, difference {:.3g}, limit "
                   "{:.3g}\">{}</failure>\n  </testcase>\n",
                   check.computed, e.value.si(), check.difference(), e.limit(),
                   escaped("Expected: " + e.source + ". Tolerance: " + e.reason));
}

std::string unreadable_case(const CaseResult& result) {
  return fmt::format(
      "  <testcase classname=\"{}\" name=\"is read\" time=\"0\">\n    <error message=\"{}\"/>\n"
      "  </testcase>\n",
      escaped(result.file), escaped(result.outcome.message));
}

}  // namespace

std::string junit_xml(const std::vector<CaseResult>& results) {
  std::string body;
  int tests = 0, failures = 0, errors = 0;
  double seconds = 0;
  for (const auto& result : results) {
    seconds += result.outcome.wall_seconds;
    if (result.checks.empty()) {
      ++tests, ++errors;
      body += unreadable_case(result);
    }
    for (const auto& check : result.checks) {
      ++tests;
      if (!result.completed()) ++errors;
      else if (!check.passed()) ++failures;
      body += test_case(result, check);
    }
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"orthodyn verify\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\" time=\"{:.3f}\">\n{}</testsuite>\n",
      tests, failures, errors, seconds, body);
}

}  // namespace orthodyn::study
