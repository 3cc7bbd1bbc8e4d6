// An integrator in a study's file: a name, `all`, or a section {type, label, any option of the integrator}.
#pragma once

#include <string>
#include <vector>

#include "lib/study/inputs/assignments.h"

namespace orthodyn {

// An entry without `rtol`, `step` and `safety`, which the study sets.
struct IntegratorEntry {
  std::string type, label;
  Assignments options;  // of the integrator, by key
  SourceLocation origin;
  bool by_all = false;  // made from `all`: skipped if the comparison has no values for its error control
};

// A section with any option, including `rtol`, `step` and `safety`.
struct CompleteIntegratorEntry : IntegratorEntry {};

// Replaces `all` by one entry per registered integrator.
std::vector<IntegratorEntry> expand_all(const std::vector<IntegratorEntry>& entries);

// True if `integrator`, which must be registered, has the option `key`.
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
