#include "lib/study/converge/convergence_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/digits.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::converge {

namespace {

std::string number(const Json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

// With the digits that its error leaves: the distance to the limit, which is uncertain itself, or the mesh's estimate.
std::string value_text(const Json& metric, const Json& at) {
  if (!at.at("value").is_number()) return "-";
  const double value = at.at("value");
  if (at.at("error").is_number()) {
    const double uncertainty = metric.at("uncertainty").get<double>() / std::abs(metric.at("limit").get<double>());
    return known_digits(value, std::max(std::abs(at.at("error").get<double>()), uncertainty));
  }
  return at.at("mesh_error").is_number() ? known_digits(value, at.at("mesh_error")) : fmt::format("{:.6g}", value);
}

std::string heading(const Json& metric) {
  const std::string unit = metric.at("unit");
  return metric.at("name").get<std::string>() + (unit.empty() ? "" : " [" + unit + "]");
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

}  // namespace

std::string convergence_csv(const Json& table) {
  std::string out = "order,level,elements,unknowns,status,reason";
  for (const auto& metric : table.at("metrics")) {
    const std::string name = metric.at("name");
    for (const std::string& head :
         {heading(metric), name + ".error", name + ".observed_order", name + ".mesh_error", name + ".cpu_seconds [s]"})
      out += "," + csv_cell(head);
  }
  out += "\n";
  for (const auto& row : table.at("rows")) {
    out += csv_cell(row.at("order"));
    for (const char* key : {"level", "elements", "unknowns", "status", "reason"}) out += "," + csv_cell(row.at(key));
    for (const auto& metric : table.at("metrics")) {
      const Json& f = row.at("metrics").at(metric.at("name").get<std::string>());
      for (const char* key : {"value", "error", "order", "mesh_error", "cpu_seconds"}) out += "," + csv_cell(f.at(key));
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
    out += fmt::format("\n{}", heading(metric));
    out += fmt::format("\n  {:>5} {:>5} {:>9} {:>13} {:>9} {:>6} {:>10} {:>9}\n", "order", "level", "unknowns", "value",
                       "error", "order", "mesh error", "CPU [s]");
    for (const auto& row : table.at("rows")) {
      const Json& f = row.at("metrics").at(name);
      out += fmt::format("  {:>5} {:>5} {:>9} {:>13} {:>9} {:>6} {:>10} {:>9}{}\n", row.at("order").get<int>(),
                         row.at("level").get<int>(), number(row.at("unknowns"), "{:.0f}"), value_text(metric, f),
                         number(f.at("error"), "{:.1e}"), number(f.at("order"), "{:.2f}"),
                         number(f.at("mesh_error"), "{:.1e}"), number(f.at("cpu_seconds"), "{:.3g}"),
                         row.at("status") == "completed"
                             ? ""
                             : "  " + row.at("status").get<std::string>() + ": " + row.at("reason").get<std::string>());
    }
    if (metric.at("limit").is_number()) out += "  " + costs(table, metric) + "\n";
  }
  return out;
}

}  // namespace orthodyn::study::converge
