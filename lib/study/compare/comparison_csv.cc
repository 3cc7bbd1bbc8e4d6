// compare.csv: one row per point of a comparison.
#include <fmt/format.h>

#include <algorithm>

#include "lib/study/compare/comparison_table.h"
#include "lib/study/jobs/json_fields.h"

namespace orthodyn::study::compare {

namespace {

// Names of all problems' probes or quantities, each once, in order of appearance. `scales`: the key of a problem whose
// object has these names.
std::vector<std::string> scaled_names(const Json& comparison, const std::string& scales) {
  std::vector<std::string> names;
  for (const auto& problem : comparison.at("problems"))
    if (problem.at(scales).is_object())
      for (const auto& [name, scale] : problem.at(scales).items())
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::vector<CsvColumn> columns_of(const Json& comparison) {
  std::vector<CsvColumn> all{{"problem", "", {"problem"}},         {"method", "", {"method"}},
                             {"control", "", {"control", "kind"}}, {"control_value", "", {"control", "value"}},
                             {"status", "", {"status"}},           {"reason", "", {"reason"}}};
  const auto names = [&](const std::string& key) {
    return scaled_names(comparison, key == "probes" ? "probe_scales" : "quantity_scales");
  };
  for (auto& column : point_fields().columns(names)) all.push_back(std::move(column));
  all.push_back({"scene", "", {"scene"}});
  return all;
}

bool is_near_reference(const Json& point, const std::string& error) {
  const Json& names = point.at("near_reference");
  return std::find(names.begin(), names.end(), error) != names.end();
}

bool is_on_pareto_front(const Json& comparison, std::size_t point) {
  const Json& fronts = comparison.at("pareto_fronts");
  return std::any_of(fronts.begin(), fronts.end(), [&](const Json& front) {
    const Json& points = front.at("points");
    return std::find(points.begin(), points.end(), point) != points.end();
  });
}

}  // namespace

std::string comparison_csv(const Json& comparison) {
  const auto columns = columns_of(comparison);
  const bool has_pareto_fronts = !comparison.at("pareto_fronts").empty();
  std::string out = fmt::format("{},near_reference.{}{}\n", csv_head(columns), kLeadingError,
                                has_pareto_fronts ? ",pareto_front" : "");
  for (std::size_t k = 0; k < comparison.at("points").size(); ++k) {
    const Json& point = comparison.at("points")[k];
    out += csv_row(columns, point) + (is_near_reference(point, kLeadingError) ? ",true" : ",false");
    if (has_pareto_fronts) out += is_on_pareto_front(comparison, k) ? ",true" : ",false";
    out += '\n';
  }
  return out;
}

}  // namespace orthodyn::study::compare
