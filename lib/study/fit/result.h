// The result of a fit, as JSON for the report, as CSV tables, as text, and as materials to use in scenes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/output/json.h"
#include "lib/study/fit/profile.h"

namespace orthodyn::study::fit {

// A search that ended, or failed at its start.
struct Attempt {
  Vector start;  // parameters, SI
  std::optional<Search> search;
  std::string failure;  // "" if the search ended
};

struct Result {
  std::vector<Attempt> attempts;
  std::size_t best = 0;  // index of the attempt with the least cost
  Statistics statistics;
  std::vector<ProfileInterval> profiles;  // empty unless wanted
  std::optional<Vector> shift;            // of the parameters by a refinement of the meshes, SI
  std::string refinement_failure;
  std::vector<CandidateValue> candidates;
  std::string candidates_failure;
  std::size_t runs = 0;    // jobs, without those found on disk
  double cpu_seconds = 0;  // of these jobs

  const Search& search() const { return *attempts[best].search; }
};

// What the data say about the parameters, in sentences, the most important first.
std::vector<std::string> findings(const Problem& problem, const Result& result);

// Reasons to distrust the result; each says what to do.
std::vector<std::string> warnings(const Problem& problem, const Result& result);

// `file`: path of the fit's file.
Json fit_json(const Fit& fit, const Problem& problem, const Result& result, const std::string& file);

// Parameters with intervals; data with computed values and residuals. From fit_json().
std::string parameters_csv(const Json& table);
std::string data_csv(const Json& table);

// The table of parameters, findings and warnings for a terminal.
std::string fit_text(const Json& table);

// A material of the scenes with the fitted constants.
struct FittedMaterial {
  std::string name;
  std::string yaml;  // its section, with comments; a scene uses the file by `NAME: {include: FILE}`
};
// Those materials that have fitted constants.
std::vector<FittedMaterial> fitted_materials(const Fit& fit, const Problem& problem, const Result& result);

}  // namespace orthodyn::study::fit
