#include "lib/study/inputs/assignments.h"

#include <string_view>
#include <utility>

namespace orthodyn {

Config parsed(const YamlText& value) { return Config::from_text("v: " + value.text).at("v"); }

void assign(Config& scene, const std::string& path, const YamlText& value) {
  scene.override_with(path + "=" + value.text);
}

void assign(Config& scene, const Assignments& assignments) {
  for (const auto& [path, value] : assignments) assign(scene, path, value);
}

std::string relocate_error(const std::string& message, const Assignments& assignments) {
  constexpr std::string_view kSet = "--set ";
  const auto at = message.find(kSet);
  if (at == std::string::npos) return message;
  const std::string wrong = message.substr(at + kSet.size());  // "a.b.0: must be ..." or "a.b.0=5: there is ..."
  const std::pair<std::string, YamlText>* nearest = nullptr;
  for (const auto& assignment : assignments) {
    const std::string& path = assignment.first;
    if (assignment.second.origin.where.empty() || !wrong.starts_with(path) || wrong.size() == path.size() ||
        std::string(".:=").find(wrong[path.size()]) == std::string::npos)
      continue;
    if (!nearest || path.size() >= nearest->first.size()) nearest = &assignment;  // the last one holds
  }
  if (!nearest) return message;
  const std::string rest = wrong.substr(nearest->first.size());
  return nearest->second.origin.where + (rest.front() == '=' ? ": " + message : rest);
}

}  // namespace orthodyn
