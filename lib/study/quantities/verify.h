// Verification: runs scenes and checks their expectations.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/scene/expectation.h"
#include "lib/simulation/run/outcome.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn::study {

// An expectation and the computed value.
struct Check {
  Expectation expectation;
  double computed = 0;  // NaN if the run has no such metric
  std::string unit = {};
  double difference() const { return computed - expectation.value; }
  bool passed() const;
};

struct CaseResult {
  std::string file;
  Outcome outcome;
  std::vector<Check> checks;

  bool completed() const { return outcome.status == Outcome::Status::completed; }
  bool passed() const;
};

// Replaces each folder by its YAML files in alphabetical order; subfolders are ignored. Throws ConfigError for a
// missing path and for a folder without YAML files.
std::vector<std::string> find_cases(const std::vector<std::string>& places);

// Throws ConfigError if the scene has no expectations.
void require_expectations(const Scene& scene, const Config& config);

// Runs a scene and checks its expectations. A failed run is a result, not an exception. Throws ConfigError for an
// invalid scene or one without expectations.
CaseResult verify(const Config& scene);

// As above, for a scene that is already set up. `observers` are called in dynamic runs only.
CaseResult verify(const Setup& setup, const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt);

// JUnit XML with one test per expectation, or one failing test for a case that could not be read.
std::string junit_xml(const std::vector<CaseResult>& results);

}  // namespace orthodyn::study
