#include "lib/simulation/checkpoint/total_cost.h"

#include "lib/simulation/output/json.h"

namespace orthodyn {

Archive TotalCost::archive() const {
  Archive out;
  for (const auto& [name, count] : kStatisticsCounts) out.put(name, static_cast<double>(statistics.*count));
  for (const auto& [name, cost] : kStatisticsCosts)
    out.put(name, {static_cast<double>((statistics.*cost).count), (statistics.*cost).seconds});
  out.put("seconds", {wall_seconds, cpu_seconds});
  return out;
}

TotalCost TotalCost::from(const Archive& archive) {
  TotalCost out;
  for (const auto& [name, count] : kStatisticsCounts) out.statistics.*count = static_cast<long>(archive.count(name));
  for (const auto& [name, cost] : kStatisticsCosts) {
    const auto& values = archive.numbers(name, 2);
    out.statistics.*cost = {static_cast<long>(values[0]), values[1]};
  }
  const auto& seconds = archive.numbers("seconds", 2);
  out.wall_seconds = seconds[0];
  out.cpu_seconds = seconds[1];
  return out;
}

TotalCost operator+(const TotalCost& a, const TotalCost& b) {
  TotalCost sum = a;
  for (const auto& [name, count] : kStatisticsCounts) sum.statistics.*count += b.statistics.*count;
  for (const auto& [name, cost] : kStatisticsCosts) {
    (sum.statistics.*cost).count += (b.statistics.*cost).count;
    (sum.statistics.*cost).seconds += (b.statistics.*cost).seconds;
  }
  sum.wall_seconds += b.wall_seconds;
  sum.cpu_seconds += b.cpu_seconds;
  return sum;
}

}  // namespace orthodyn
