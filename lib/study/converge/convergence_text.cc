// Results of a convergence study as CSV and text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_format.h"
#include "lib/study/converge/convergence_table.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::converge {

namespace {

std::string number(const Json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

// The value with the digits that its error justifies. The error is the distance from the limit or the limit's
// uncertainty, whichever is larger; without a limit, the estimated mesh error.
std::string value_text(const Json& metric, const Json& at) {
  if (!at.at("value").is_number()) return "-";
  const double value = at.at("value");
  if (at.at("error").is_number()) {
    const double uncertainty = metric.at("uncertainty").get<double>() / std::abs(metric.at("limit").get<double>());
    return known_digits(value, std::max(std::abs(at.at("error").get<double>()), uncertainty));
  }
  return at.at("mesh_error").is_number() ? known_digits(value, at.at("mesh_error")) : fmt::format("{:.6g}", value);
}

std::string costs(const Json& table, const Json& metric) {
  std::string out;
  for (const auto& cost : metric.at("cost_of_target"))
    out += fmt::format("{}order {}: {}", out.empty() ? "" : ", ", cost.at("order").get<int>(),
                       cost.at("cpu_seconds").is_number()
                           ? fmt::format("{}{:.2g} s", cost.at("at_most").get<bool>() ? "at most " : "",
                                         cost.at("cpu_seconds").get<double>())
                           : std::string("not reached"));
  return fmt::format("CPU time for an error of {:.0f} %: {}", 100 * table.at("target").get<double>(), out);
}

std::string with_unit(double value, double relative_error, const std::string& unit) {
  return known_digits(value, relative_error) + (unit.empty() ? "" : " " + unit);
}

// "; an error of 1 % takes 0.5 s of CPU with quadratic elements", for the cheapest element order.
std::string cost(const Json& metric, double target) {
  const Json* best = nullptr;
  for (const Json& c : metric.at("cost_of_target"))
    if (c.at("cpu_seconds").is_number() && (!best || c.at("cpu_seconds") < best->at("cpu_seconds"))) best = &c;
  if (!best) return fmt::format("; no mesh reaches an error of {:g} %", 100 * target);
  return fmt::format("; an error of {:g} % takes {}{:.2g} s of CPU with {} elements", 100 * target,
                     best->at("at_most").get<bool>() ? "at most " : "", best->at("cpu_seconds").get<double>(),
                     words_of_order(best->at("order").get<int>()));
}

}  // namespace

std::string convergence_csv(const Json& table) {
  std::string out = "order,level,elements,unknowns,status,reason";
  for (const auto& metric : table.at("metrics")) {
    const std::string name = metric.at("name");
    for (const std::string& head : {csv_heading(name, metric.at("unit")), name + ".error", name + ".observed_order",
                                    name + ".mesh_error", name + ".cpu_seconds [s]"})
      out += "," + csv_cell(head);
  }
  out += "\n";
  for (const auto& row : table.at("rows")) {
    out += csv_cell(row.at("order"));
    for (const char* key : {"level", "elements", "unknowns", "status", "reason"}) out += "," + csv_cell(row.at(key));
    for (const auto& metric : table.at("metrics")) {
      const Json& m = row.at("metrics").at(metric.at("name").get<std::string>());
      for (const char* key : {"value", "error", "order", "mesh_error", "cpu_seconds"}) out += "," + csv_cell(m.at(key));
    }
    out += "\n";
  }
  return out;
}

std::string convergence_text(const Json& table) {
  std::string out;
  for (const auto& metric : table.at("metrics")) out += fmt::format("{}\n", metric.at("answer").get<std::string>());
  for (const auto& metric : table.at("metrics")) {
    const std::string name = metric.at("name");
    out += fmt::format("\n{}", csv_heading(name, metric.at("unit")));
    out += fmt::format("\n  {:>5} {:>5} {:>9} {:>13} {:>9} {:>6} {:>10} {:>9}\n", "order", "level", "unknowns", "value",
                       "error", "order", "mesh error", "CPU [s]");
    for (const auto& row : table.at("rows")) {
      const Json& m = row.at("metrics").at(name);
      out += fmt::format("  {:>5} {:>5} {:>9} {:>13} {:>9} {:>6} {:>10} {:>9}{}\n", row.at("order").get<int>(),
                         row.at("level").get<int>(), number(row.at("unknowns"), "{:.0f}"), value_text(metric, m),
                         number(m.at("error"), "{:.1e}"), number(m.at("order"), "{:.2f}"),
                         number(m.at("mesh_error"), "{:.1e}"), number(m.at("cpu_seconds"), "{:.3g}"),
                         row.at("status") == "completed"
                             ? ""
                             : "  " + row.at("status").get<std::string>() + ": " + row.at("reason").get<std::string>());
    }
    if (metric.at("limit").is_number()) out += "  " + costs(table, metric) + "\n";
  }
  return out;
}

const char* words_of_order(int order) { return order == 1 ? "linear" : "quadratic"; }

std::string answer(const Json& metric, const std::optional<FinestMesh>& finest, double target) {
  const std::string name = metric.at("name"), unit = metric.at("unit");
  if (metric.at("limit").is_number()) {
    const double limit = metric.at("limit"), uncertainty = metric.at("uncertainty");
    const double relative = limit == 0 ? uncertainty : std::abs(uncertainty / limit);
    return fmt::format("{} is {} +- {:.1g} (from {} elements){}", name, with_unit(limit, relative, unit), uncertainty,
                       words_of_order(metric.at("from_order").get<int>()), cost(metric, target));
  }
  if (!finest) return fmt::format("{} is unknown: no mesh has a value", name);
  return fmt::format("{} has no limit yet: {}. The finest mesh gives {}{}", name,
                     metric.at("why_no_limit").get<std::string>(), with_unit(finest->value, finest->mesh_error, unit),
                     std::isfinite(finest->mesh_error)
                         ? fmt::format(" with an estimated mesh error of {:.2g} %", 100 * finest->mesh_error)
                         : ", without an error estimate");
}

}  // namespace orthodyn::study::converge
