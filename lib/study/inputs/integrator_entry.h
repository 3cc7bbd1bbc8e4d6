// An integrator in the list of a study's file: a name, `all`, or a section {type, label, any option of the integrator}.
#pragma once

#include <string>
#include <vector>

#include "lib/study/inputs/assignments.h"

namespace orthodyn {

// Without what controls its error, which the study varies.
struct IntegratorEntry {
  std::string type, label;
  Assignments options;  // by key of the integrator
  SourceLocation origin;
  bool by_all = false;  // named by `all`: left out if it takes nothing that the comparison gives
};

// A section with all options, those that control the error among them.
struct CompleteIntegratorEntry : IntegratorEntry {};

// With `all` replaced by one entry for each of the registry.
std::vector<IntegratorEntry> expand_all(const std::vector<IntegratorEntry>& entries);

// Whether an integrator of the registry has an option.
bool has_key(const std::string& integrator, const std::string& key);

template <>
struct Value<IntegratorEntry> {
  static ValueSchema schema();
  static IntegratorEntry read(const Config& c, const Rule&);
  static std::string yaml(const IntegratorEntry&) { return ""; }
};

template <>
struct Value<CompleteIntegratorEntry> {
  static ValueSchema schema();
  static CompleteIntegratorEntry read(const Config& c, const Rule&);
  static std::string yaml(const CompleteIntegratorEntry&) { return ""; }
};

}  // namespace orthodyn
