// What one point of a comparison is to do, and what came out, as JSON: the border between the process
// that compares and the one that measures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/errors/error_norms.h"
#include "lib/simulation/json.h"

namespace orthodyn {

struct Job {
  int repeats = 1, samples = 100;
  double seconds = 60;               // limit of one integration
  std::string reference;             // folder of a reference's result; "" for none
  bool keep_trajectory = false;      // for others to be measured against
  bool exact_if_possible = false;    // the exact solution in place of an integration, where there is one
  std::string code;                  // fingerprint of the program that is to do it

  Json json() const;
  static Job from(const Json& json);
};

Json to_json(const TrajectoryErrors& errors);
Json to_json(const TrajectoryScales& scales);

// Of a file; discarded (no object) if there is none or it is cut short.
Json read_json(const std::filesystem::path& file);

// As text, whatever bytes a file or a crashed program has put in.
std::string to_text(const Json& json, int indent = -1);

// Null for infinite and undefined numbers: JSON has no word for them.
Json finite_or_null(double x);

// {"median": ..., "min": ..., "max": ...}
Json spread(std::vector<double> values);

}  // namespace orthodyn
