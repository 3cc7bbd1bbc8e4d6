#include "lib/mesh/io/abaqus_amplitude.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace orthodyn {
namespace {

// The parameter that gives another curve than a table of relative values, "" if there is none.
std::string parameter_of_another_curve(const AbaqusKeyword& keyword) {
  static const std::map<std::string, std::vector<std::string>> plain{
      {"DEFINITION", {"TABULAR"}}, {"VALUE", {"RELATIVE"}}, {"TIME", {"STEPTIME", "TOTALTIME"}}};
  for (const auto& [name, value] : keyword.parameters) {
    if (name == "NAME") continue;
    const auto values = plain.find(name);
    const std::string given = abaqus_word(value);
    if (values == plain.end()) return name;
    const bool is_plain = std::any_of(values->second.begin(), values->second.end(), [&](const std::string& word) {
      return !given.empty() && word.starts_with(given);  // words may be shortened
    });
    if (!is_plain) return fmt::format("{}={}", name, value);
  }
  return "";
}

// All numbers behind each other, a whole number of pairs; none if one is no number, or missing in a line before the
// last.
std::optional<std::vector<double>> amplitude_numbers(AbaqusLines& lines) {
  std::vector<double> numbers;
  while (!lines.at_keyword()) {
    for (const std::string_view field : lines.data()) {
      const std::optional<double> number = abaqus_number(field);
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
    if (numbers.size() % 2 == 1 && !lines.at_keyword()) return std::nullopt;
  }
  numbers.resize(numbers.size() + numbers.size() % 2);  // a zero may be left out at the end
  return numbers;
}

}  // namespace

AbaqusAmplitude read_abaqus_amplitude(const AbaqusKeyword& keyword, AbaqusLines& lines) {
  AbaqusAmplitude out{.name = keyword.parameter("NAME"), .place = keyword.place};
  const std::string own = fmt::format("*AMPLITUDE {} (line {})", out.name, out.place.line);
  const std::string other = parameter_of_another_curve(keyword);
  const auto numbers = amplitude_numbers(lines);
  lines.skip_data();
  if (!other.empty()) out.problem = fmt::format("{} of {} is not read", other, own);
  else if (!numbers || numbers->empty()) out.problem = own + " has no pairs of a time and a value";
  if (!out.problem.empty()) return out;
  for (std::size_t k = 0; k < numbers->size(); k += 2) out.points.push_back({(*numbers)[k], (*numbers)[k + 1]});
  const auto does_not_ascend = [](const auto& a, const auto& b) { return a[0] >= b[0]; };
  if (std::adjacent_find(out.points.begin(), out.points.end(), does_not_ascend) != out.points.end())
    out.problem = fmt::format("the times of {} do not ascend", own);
  return out;
}

}  // namespace orthodyn
