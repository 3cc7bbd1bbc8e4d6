#include "lib/study/sweep/key_unit.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <sstream>

#include "lib/core/parse_number.h"
#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

using Steps = std::deque<std::string>;

std::optional<Config> below(const std::optional<Config>& config, const std::string& step) {
  if (!config) return {};
  if (config->is_map() && config->has(step)) return config->at(step);
  std::size_t index = 0;
  if (config->is_sequence() && parse_number(step, index) && index < config->size()) return config->at(index);
  return {};
}

std::string unit_of(const std::vector<Key>& keys, const std::optional<Config>& section, Steps steps);

std::string unit_of(const ValueSchema& schema, const std::string& unit, const std::optional<Config>& config,
                    Steps steps) {
  const auto next = [&] {
    const std::string step = steps.front();
    steps.pop_front();
    return below(config, step);
  };
  switch (schema.kind) {
    case ValueSchema::Kind::number: return steps.empty() ? unit : "";
    case ValueSchema::Kind::list: {
      if (steps.empty()) return unit_of(schema.items.front(), unit, {}, {});
      const auto entry = next();
      return unit_of(schema.items.front(), unit, entry, steps);
    }
    case ValueSchema::Kind::named: {
      if (steps.empty()) return "";
      const auto entry = next();
      return unit_of(schema.items.front(), unit, entry, steps);
    }
    case ValueSchema::Kind::section: return unit_of(schema.keys(), config, steps);
    case ValueSchema::Kind::choice: {
      const auto type = below(config, "type");
      const auto alternatives = schema.alternatives();
      const auto chosen = type && type->is_scalar() ? alternatives.find(type->text()) : alternatives.end();
      return chosen == alternatives.end() ? "" : unit_of(chosen->second.keys, config, steps);
    }
    case ValueSchema::Kind::either:
      for (const auto& item : schema.items)
        if (std::string found = unit_of(item, unit, config, steps); !found.empty()) return found;
      return "";
    default: return "";
  }
}

std::string unit_of(const std::vector<Key>& keys, const std::optional<Config>& section, Steps steps) {
  if (steps.empty()) return "";
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == steps.front(); });
  if (key == keys.end()) return "";
  const auto value = below(section, steps.front());
  steps.pop_front();
  return unit_of(key->schema, key->unit, value, steps);
}

}  // namespace

std::string unit_at(const std::string& path, const Config& scene) {
  Steps steps;
  std::istringstream in(path);
  for (std::string step; std::getline(in, step, '.');) steps.push_back(step);
  return unit_of(Scene::spec().keys(), scene, steps);
}

}  // namespace orthodyn
