#include "lib/simulation/output/json.h"

namespace orthodyn {

Json to_json(const Statistics& statistics) {
  Json out = Json::object();
  for (const auto& [name, count] : kStatisticsCounts) out[name] = statistics.*count;
  for (const auto& [name, cost] : kStatisticsCosts)
    out[name] = {{"count", (statistics.*cost).count}, {"seconds", (statistics.*cost).seconds}};
  return out;
}

Statistics statistics_from(const Json& json) {
  Statistics out;
  for (const auto& [name, count] : kStatisticsCounts) out.*count = json.at(name);
  for (const auto& [name, cost] : kStatisticsCosts) {
    if (!json.contains(name)) continue;  // absent in older results
    out.*cost = {json.at(name).at("count"), json.at(name).at("seconds")};
  }
  return out;
}

}  // namespace orthodyn
