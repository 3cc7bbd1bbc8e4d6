// Runs scenes with expectations and says whether they are met.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/simulation/run/outcome.h"
#include "lib/simulation/run/setup.h"
#include "lib/study/quantities/check.h"

namespace orthodyn::study {

struct CaseResult {
  std::string file;
  Outcome outcome;
  std::vector<Check> checks;

  bool completed() const { return outcome.status == Outcome::Status::completed; }
  bool passed() const;
};

// The YAML files among the given files and folders, folders without their subfolders and in
// alphabetical order. Throws ConfigError for what does not exist and for a folder without cases.
std::vector<std::string> find_cases(const std::vector<std::string>& places);

// Throws ConfigError if the scene expects nothing.
void require_expectations(const Scene& scene, const Config& config);

// Throws ConfigError for a scene that is at fault or expects nothing. A run that fails is a result.
CaseResult verify(const Config& scene);

// The same of what is set up already, with others that look on at a motion.
CaseResult verify(const Setup& setup, const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt);

// One suite of JUnit XML: a test per expectation, one for a case that has none since it could not be read.
std::string junit_xml(const std::vector<CaseResult>& results);

}  // namespace orthodyn::study
