#include "lib/scene/layup.h"

#include <fmt/format.h>

#include <cmath>

namespace orthodyn {

ValueSchema Value<Ply>::schema() {
  ValueSchema item{.kind = ValueSchema::Kind::either, .items = {Value<std::string>::schema(), Value<double>::schema()}};
  return list_schema(std::move(item), 3, "[material, angle, thickness]");
}

Ply Value<Ply>::read(const Config& c, const Rule&) {
  if (!c.is_sequence() || c.size() != 3) c.fail_expected("[material, angle, thickness]");
  return {c.at(0).text(), read_number(c.at(1), {.unit = "rad"}),
          read_number(c.at(2), {.unit = "m", .range = kPositive})};
}

std::string Value<Ply>::yaml(const Ply& ply) {
  return fmt::format("[{}, {} rad, {}]", ply.material, number_text(ply.angle), number_text(ply.thickness));
}

double total_thickness(const std::vector<Ply>& layup) {
  double sum = 0;
  for (const Ply& ply : layup) sum += ply.thickness;
  return sum;
}

std::vector<PlyPart> divide(const std::vector<Ply>& layup, const Stack& stack) {
  constexpr double kRoundOff = 1e-6;  // of a cell's height: boundaries of plies that are nearer to its ends move there
  const double total = total_thickness(layup);
  std::vector<PlyPart> parts;
  std::vector<int> count(layup.size(), 0);
  for (std::size_t l = 0; l < stack.levels.size(); ++l) {
    const StackLevel& level = stack.levels[l];
    const auto place = [&](double height) {
      const double t = 2 * (height - level.bottom) / (level.top - level.bottom) - 1;
      return std::abs(t) > 1 - 2 * kRoundOff ? std::copysign(1.0, t) : t;
    };
    double below = 0;
    for (std::size_t i = 0; i < layup.size(); ++i) {
      const double begin = place(below / total);
      below += layup[i].thickness;
      const double end = i + 1 == layup.size() ? 1 : place(below / total);
      if (end <= begin) continue;
      parts.push_back({i, fmt::format("ply_{}", i + 1), l, begin, end});
      ++count[i];
    }
  }
  std::vector<int> part(layup.size(), 0);
  for (PlyPart& p : parts)
    if (count[p.ply] > 1) p.name += fmt::format("_{}", ++part[p.ply]);
  return parts;
}

}  // namespace orthodyn
