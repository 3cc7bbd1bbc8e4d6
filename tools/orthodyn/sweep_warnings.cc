#include "tools/orthodyn/sweep_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "lib/simulation/error_estimate/mesh_error.h"

namespace orthodyn::study::sweep {

namespace {

void warn_of_coarse_meshes(const Json& table) {
  const Json* worst = nullptr;
  std::size_t count = 0;
  for (const auto& point : table.at("points")) {
    if (!point.at("mesh_error").is_number() || !(point.at("mesh_error") > kCoarseMesh)) continue;
    ++count;
    if (!worst || point.at("mesh_error") > worst->at("mesh_error")) worst = &point;
  }
  if (!worst) return;
  fmt::print(stderr,
             "warning: the mesh is coarse for {} of {} points: its error is up to {:.2g} of the elastic energy ({}). "
             "Deflections are too small and frequencies too high; orthodyn converge estimates by how much\n",
             count, table.at("points").size(), worst->at("mesh_error").get<double>(),
             worst->at("title").get<std::string>());
}

// Frequencies have their own error estimate.
void warn_of_coarse_frequencies(const Json& table) {
  std::size_t count = 0;
  double worst = 0;
  std::string which;
  for (const auto& point : table.at("points")) {
    bool is_coarse = false;
    for (const auto& [metric, error] : point.at("metric_errors").items()) {
      if (!error.is_number() || !(std::abs(error.get<double>()) > kCoarseMesh)) continue;
      is_coarse = true;
      if (std::abs(error.get<double>()) <= std::abs(worst)) continue;
      worst = error.get<double>();
      which = fmt::format("{}, {}", metric, point.at("title").get<std::string>());
    }
    count += is_coarse;
  }
  if (count > 0)
    fmt::print(stderr,
               "warning: the mesh is coarse for frequencies of {} of {} points: up to {:.2g} % too {} ({}; columns "
               ".mesh_error of sweep.csv)\n",
               count, table.at("points").size(), 100 * std::abs(worst), worst > 0 ? "high" : "low", which);
}

// A warning without the point's folder and numbers, so that warnings of different points can be compared.
std::string kind_of(const std::string& warning) {
  const auto scene = warning.find("scene.yaml");
  std::string kind = scene == std::string::npos ? warning : warning.substr(scene);
  std::erase_if(kind, [](unsigned char c) { return !std::isalpha(c); });
  return kind;
}

std::set<std::string> kinds_of(const Json& point) {
  std::set<std::string> kinds;
  for (const auto& warning : point.at("warnings")) kinds.insert(kind_of(warning.get<std::string>()));
  return kinds;
}

void warn_of_points(const Json& table) {
  const Json& points = table.at("points");
  const std::set<std::string> known = points.empty() ? std::set<std::string>() : kinds_of(points.front());
  std::string example;
  std::size_t count = 0;
  for (const auto& point : points) {
    const Json& warnings = point.at("warnings");
    const auto other = std::find_if(warnings.begin(), warnings.end(), [&](const Json& warning) {
      return !known.contains(kind_of(warning.get<std::string>()));
    });
    if (other == warnings.end()) continue;
    if (++count == 1) example = fmt::format("{}: {}", point.at("title").get<std::string>(), other->get<std::string>());
  }
  if (count > 0)
    fmt::print(stderr,
               "warning: {} of {} points have further warnings (column 'warnings' of sweep.csv); the first: {}\n",
               count, points.size(), example);
}

}  // namespace

void warn_of_impossible_points(const std::vector<Point>& points) {
  std::size_t count = 0;
  for (const auto& point : points)
    if (!point.impossible.empty() && ++count == 1)
      fmt::print(stderr, "warning: {} cannot be computed: {}\n", point.title, point.impossible);
  if (count > 1) fmt::print(stderr, "warning: {} more points cannot be computed either\n", count - 1);
}

void warn_of_finished_points(const Json& table) {
  warn_of_coarse_meshes(table);
  warn_of_coarse_frequencies(table);
  warn_of_points(table);
}

}  // namespace orthodyn::study::sweep
