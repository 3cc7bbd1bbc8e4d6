// compare.csv: the points of a comparison, one row each.
#include <fmt/format.h>

#include <algorithm>

#include "lib/study/compare/comparison_table.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::compare {

namespace {

struct Column {
  std::string title;
  std::vector<std::string> path;  // into a point
};

// In the order in which problems have them, each once.
std::vector<std::string> scaled_names(const Json& comparison, const char* scales) {
  std::vector<std::string> names;
  for (const auto& problem : comparison.at("problems"))
    if (problem.at(scales).is_object())
      for (const auto& [name, scale] : problem.at(scales).items())
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::vector<Column> columns_of(const Json& comparison) {
  std::vector<Column> all{{"problem", {"problem"}},
                          {"method", {"method"}},
                          {"control", {"control", "kind"}},
                          {"control_value", {"control", "value"}},
                          {"status", {"status"}},
                          {"reason", {"reason"}},
                          {"time_reached [s]", {"time_reached"}},
                          {"repeats", {"repeats"}}};
  for (const char* clock : {"wall", "cpu"})
    for (const char* figure : {"median", "min", "max"})
      all.push_back({fmt::format("{}.{} [s]", clock, figure), {clock, figure}});
  for (const char* count : {"steps", "rejected_steps", "error_test_failures", "convergence_failures",
                            "newton_iterations", "gauss_newton_fallbacks"})
    all.push_back({count, {"statistics", count}});
  for (const char* work : {"force", "tangent", "factorization", "solve"}) {
    all.push_back({fmt::format("{}.count", work), {"statistics", work, "count"}});
    all.push_back({fmt::format("{}.seconds [s]", work), {"statistics", work, "seconds"}});
  }
  all.push_back({"peak_memory [bytes]", {"peak_memory_bytes"}});
  all.push_back({"factor [bytes]", {"factor_bytes"}});
  const auto add_errors = [&](std::vector<std::string> path, const std::string& name) {
    for (const char* norm : {"final", "l2", "max"}) {
      path.push_back(norm);
      all.push_back({fmt::format("error.{}.{}", name, norm), path});
      path.pop_back();
    }
  };
  add_errors({"errors", "displacement"}, "displacement");
  add_errors({"errors", "velocity"}, "velocity");
  for (const auto& probe : scaled_names(comparison, "probe_scales"))
    add_errors({"errors", "probes", probe}, "probe." + probe);
  for (const auto& quantity : scaled_names(comparison, "quantity_scales"))
    add_errors({"errors", "quantities", quantity}, quantity);
  all.push_back({"error.phase [rad]", {"errors", "phase"}});
  for (const char* drift : {"energy", "linear_momentum", "angular_momentum"})
    all.push_back({fmt::format("drift.{}", drift), {"drift", drift}});
  all.push_back({"smallest_det_f", {"smallest_det_f"}});
  all.push_back({"scene", {"scene"}});
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

std::string cell(const Json& point, const Column& column) {
  const Json* at = &point;
  for (const auto& key : column.path) {
    if (!at->is_object() || !at->contains(key)) return "";
    at = &at->at(key);
  }
  return csv_cell(*at);
}

}  // namespace

std::string comparison_csv(const Json& comparison) {
  const auto columns = columns_of(comparison);
  std::string out;
  for (const auto& column : columns) out += (out.empty() ? "" : ",") + csv_cell(column.title);
  const bool has_pareto_fronts = !comparison.at("pareto_fronts").empty();
  out += fmt::format(",near_reference.{}{}\n", kLeadingError, has_pareto_fronts ? ",pareto_front" : "");
  for (std::size_t k = 0; k < comparison.at("points").size(); ++k) {
    const Json& point = comparison.at("points")[k];
    for (const auto& column : columns) out += cell(point, column) + ",";
    out += is_near_reference(point, kLeadingError) ? "true" : "false";
    if (has_pareto_fronts) out += is_on_pareto_front(comparison, k) ? ",true" : ",false";
    out += '\n';
  }
  return out;
}

}  // namespace orthodyn::study::compare
