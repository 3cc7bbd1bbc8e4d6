#include "lib/scene/abaqus_factors.h"

#include <fmt/format.h>

#include "lib/config/values.h"

namespace orthodyn {
namespace {

std::string amplitude_yaml(const AbaqusAmplitude& amplitude) {
  constexpr std::size_t kOnALine = 6;
  std::string points;
  for (std::size_t k = 0; k < amplitude.points.size(); ++k) {
    const auto& [time, factor] = amplitude.points[k];
    const char* separator = k == 0 ? "" : k % kOnALine == 0 ? ",\n        " : ", ";
    points += fmt::format("{}[{}, {}]", separator, number_text(time), number_text(factor));
  }
  return fmt::format("{{type: table, points: [{}]}}", points);
}

std::string amplitude_key(const AbaqusCondition& condition) {
  return in_capitals(condition.keyword.parameter("AMPLITUDE"));
}

}  // namespace

std::string AbaqusFactors::problem(const AbaqusCondition& condition) const {
  if (!condition.keyword.has("AMPLITUDE")) return "";
  const auto found = amplitudes_.find(amplitude_key(condition));
  if (found == amplitudes_.end())
    return fmt::format("the file has no *AMPLITUDE {}", condition.keyword.parameter("AMPLITUDE"));
  return found->second.problem;
}

std::string AbaqusFactors::take(const AbaqusCondition& condition) {
  if (!condition.keyword.has("AMPLITUDE")) return "";
  taken_.insert(amplitude_key(condition));
  return amplitude_yaml(amplitudes_.at(amplitude_key(condition)));
}

std::vector<std::string> AbaqusFactors::not_taken() const {
  std::vector<std::string> out;
  for (const auto& [key, amplitude] : amplitudes_)
    if (!taken_.contains(key))
      out.push_back(fmt::format("*AMPLITUDE {} (line {}): not used by a converted condition", amplitude.name,
                                amplitude.place.line));
  return out;
}

}  // namespace orthodyn
