#include "lib/study/jobs/json_fields.h"

namespace orthodyn::study {

CsvColumn below(const std::string& key, const CsvHeading& heading, CsvColumn column) {
  const std::string words = heading.words;
  column.words = words + (words.empty() || column.words.empty() ? "" : ".") + column.words;
  if (column.unit.empty()) column.unit = heading.unit;
  column.path.insert(column.path.begin(), key);
  return column;
}

std::vector<CsvColumn> JsonValue<Statistics>::columns(const std::string&, const NamesBelow&) {
  std::vector<CsvColumn> out;
  for (const char* count : {"steps", "rejected_steps", "error_test_failures", "convergence_failures",
                            "newton_iterations", "gauss_newton_fallbacks"})
    out.push_back({count, "", {count}});
  for (const std::string work : {"force", "tangent", "factorization", "solve"}) {
    out.push_back({work + ".count", "", {work, "count"}});
    out.push_back({work + ".seconds", "s", {work, "seconds"}});
  }
  return out;
}

std::string csv_head(const std::vector<CsvColumn>& columns) {
  std::string out;
  for (const auto& column : columns) out += (out.empty() ? "" : ",") + csv_cell(column.title());
  return out;
}

std::string csv_row(const std::vector<CsvColumn>& columns, const Json& object) {
  std::string out;
  for (const auto& column : columns) {
    const Json* value = &object;
    for (const auto& key : column.path)
      if (value) value = value->is_object() && value->contains(key) ? &value->at(key) : nullptr;
    if (&column != &columns.front()) out += ",";
    if (value) out += csv_cell(*value);
  }
  return out;
}

}  // namespace orthodyn::study
