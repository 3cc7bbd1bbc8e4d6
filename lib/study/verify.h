// Runs scenes with expectations and says whether they are met.
#pragma once

#include <string>
#include <vector>

#include "lib/core/config.h"
#include "lib/scene/expectation.h"

namespace orthodyn {

struct Check {
  Expectation expectation;
  double computed = 0;  // NaN where the run has no such figure
  double difference() const { return computed - expectation.value; }
  bool passed() const;
};

struct CaseResult {
  std::string file;
  std::string failure;  // why the run ended early; empty if it did not
  double seconds = 0;
  std::vector<Check> checks;

  bool passed() const;
};

// The YAML files among the given files and folders, folders without their subfolders and in
// alphabetical order. Throws ConfigError for what does not exist and for a folder without cases.
std::vector<std::string> find_cases(const std::vector<std::string>& places);

// Throws ConfigError for a scene that is at fault or expects nothing. A run that fails is a result.
CaseResult verify(const Config& scene);

// One suite of JUnit XML: a test per expectation.
std::string junit_xml(const std::vector<CaseResult>& results);

}  // namespace orthodyn
