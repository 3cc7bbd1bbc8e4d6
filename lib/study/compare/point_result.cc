#include "lib/study/compare/point_result.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace orthodyn {

namespace {

Json to_json(const ErrorNorms& e) { return {{"final", e.final}, {"l2", e.l2}, {"max", e.max}}; }

}  // namespace

Json Job::json() const {
  return {{"repeats", repeats},     {"samples", samples},
          {"seconds", seconds},     {"reference", reference},
          {"keep_trajectory", keep_trajectory}, {"exact_if_possible", exact_if_possible},
          {"code", code}};
}

Job Job::from(const Json& json) {
  return {json.at("repeats"),         json.at("samples"),         json.at("seconds"), json.at("reference"),
          json.at("keep_trajectory"), json.at("exact_if_possible"),
          json.at("code")};
}

Json to_json(const TrajectoryErrors& errors) {
  Json probes = Json::object();
  for (const auto& [name, e] : errors.probes) probes[name] = to_json(e);
  return {{"displacement", to_json(errors.displacement)},
          {"velocity", to_json(errors.velocity)},
          {"probes", probes},
          {"phase", errors.phase}};
}

Json to_json(const TrajectoryScales& scales) {
  Json probes = Json::object();
  for (const auto& [name, length] : scales.probes) probes[name] = length;
  return {{"displacement", scales.displacement},
          {"velocity", scales.velocity},
          {"probes", probes},
          {"dominant_frequency", scales.dominant_frequency}};
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return Json::parse(in, nullptr, false);
}

std::string to_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json spread(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  const double median = n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
  return {{"median", median}, {"min", values.front()}, {"max", values.back()}};
}

}  // namespace orthodyn
