#include "lib/study/converge/convergence_answer.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/digits.h"

namespace orthodyn::study::converge {

namespace {

std::string with_unit(double value, double relative_error, const std::string& unit) {
  return known_digits(value, relative_error) + (unit.empty() ? "" : " " + unit);
}

// "; an error of 1 % takes 0.5 s with quadratic elements", of the cheapest.
std::string cost(const Json& metric, double target) {
  const Json* best = nullptr;
  for (const Json& c : metric.at("cost_of_target"))
    if (c.at("cpu_seconds").is_number() && (!best || c.at("cpu_seconds") < best->at("cpu_seconds"))) best = &c;
  if (!best) return fmt::format("; no mesh comes within {:g} %", 100 * target);
  return fmt::format("; an error of {:g} % takes {}{:.2g} s of CPU with {} elements", 100 * target,
                     best->at("at_most").get<bool>() ? "at most " : "", best->at("cpu_seconds").get<double>(),
                     words_of_order(best->at("order").get<int>()));
}

}  // namespace

const char* words_of_order(int order) { return order == 1 ? "linear" : "quadratic"; }

std::string answer(const Json& metric, const std::optional<FinestMesh>& finest, double target) {
  const std::string name = metric.at("name"), unit = metric.at("unit");
  if (metric.at("limit").is_number()) {
    const double limit = metric.at("limit"), uncertainty = metric.at("uncertainty");
    const double relative = limit == 0 ? uncertainty : std::abs(uncertainty / limit);
    return fmt::format("{} is {}, known to {:.1g} (by {} elements){}", name, with_unit(limit, relative, unit),
                       uncertainty, words_of_order(metric.at("from_order").get<int>()), cost(metric, target));
  }
  if (!finest) return fmt::format("{} is not known: no mesh has it", name);
  return fmt::format("{} has no limit yet: {}. The finest mesh gives {}{}", name,
                     metric.at("why_no_limit").get<std::string>(), with_unit(finest->value, finest->mesh_error, unit),
                     std::isfinite(finest->mesh_error)
                         ? fmt::format(", whose error by the mesh is estimated at {:.2g} %", 100 * finest->mesh_error)
                         : ", of which no estimate of the error is at hand");
}

}  // namespace orthodyn::study::converge
