#include "lib/simulation/run/model_keys.h"

#include <cmath>

namespace orthodyn {

namespace {

Json json_of(const Config& value);

// 4 and not 4.0.
Json number_json(double x) {
  constexpr double kExact = 9e15;
  if (std::abs(x) < kExact && std::floor(x) == x) return static_cast<long>(x);
  return x;
}

Json scalar_json(const Config& value) {
  if (value.is_null()) return {};
  if (value.reads_as_number()) return number_json(value.number());
  const std::string text = value.text();
  if (text == "true" || text == "false") return text == "true";
  return text;
}

Json list_json(const Config& list) {
  Json out = Json::array();
  for (std::size_t k = 0; k < list.size(); ++k) out.push_back(json_of(list.at(k)));
  return out;
}

Json section_json(const Config& section) {
  Json out = Json::object();
  for (const auto& key : section.keys())
    if (Json value = json_of(section.at(key)); !value.is_null()) out[key] = std::move(value);
  return out;
}

Json json_of(const Config& value) {
  return value.is_map() ? section_json(value) : value.is_sequence() ? list_json(value) : scalar_json(value);
}

}  // namespace

Json model_keys(const Config& resolved) {
  Json out = Json::object();
  for (const char* key : {"mesh", "materials", "regions", "elasticity", "mass", "damping", "gravity", "loads", "terms",
                          "clamps", "motions", "start", "initial"})
    if (resolved.has(key) && !resolved.at(key).is_null()) out[key] = json_of(resolved.at(key));
  return out;
}

}  // namespace orthodyn
