// Writing into a YAML document.
#include <fmt/format.h>

#include <sstream>
#include <variant>
#include <vector>

#include "lib/config/yaml_document.h"
#include "lib/core/parse_number.h"

namespace orthodyn {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

// Returns an entry of a list or a section; creates a missing key.
YAML::Node entry(YAML::Node& parent, const std::string& step, const std::string& path, const std::string& place) {
  if (parent.IsMap() || parent.IsNull()) return parent[step];
  if (!parent.IsSequence())
    throw ConfigError(place,
                      fmt::format("'{}' is a value and has no keys", path.substr(0, path.size() - step.size() - 1)));
  std::size_t index = 0;
  if (!parse_number(step, index) || index >= parent.size())
    throw ConfigError(place, parent.size() == 0 ? fmt::format("'{}' is not an index: the list is empty", step)
                                                : fmt::format("'{}' is not an index of the list; expected 0 to {}",
                                                              step, parent.size() - 1));
  return parent[index];
}

struct NodeOf {
  YAML::Node operator()(std::nullptr_t) const { return YAML::Node(YAML::NodeType::Null); }
  YAML::Node operator()(bool value) const { return YAML::Node(value); }
  YAML::Node operator()(long value) const { return YAML::Node(value); }
  YAML::Node operator()(double value) const { return YAML::Node(fmt::format("{}", value)); }
  YAML::Node operator()(const std::string& text) const { return YAML::Node(text); }
  YAML::Node operator()(const std::vector<std::string>& texts) const {
    YAML::Node list(YAML::NodeType::Sequence);
    for (const auto& text : texts) list.push_back(text);
    put_on_one_line(list);
    return list;
  }
};

}  // namespace

YAML::Node node_of(const ConfigValue& value) { return std::visit(NodeOf(), value); }

void put_on_one_line(YAML::Node node) {
  if (node.IsMap() || node.IsSequence()) node.SetStyle(YAML::EmitterStyle::Flow);
  for (auto child : node) put_on_one_line(node.IsMap() ? child.second : YAML::Node(child));
}

void write_at(const YAML::Node& root, YAML::Node node, const std::string& path, const YAML::Node& value,
              const std::string& place) {
  std::string reached;
  for (const auto& step : split(path, '.')) {
    reached = child_path(reached, step);
    YAML::Node next = entry(node, step, reached, place);
    if (next.IsDefined() && occurrences(root, next) > 1)
      throw ConfigError(place,
                        fmt::format("'{}' is used in several places through an alias; change the file", reached));
    if (reached != path && (!next.IsDefined() || next.IsNull())) next = YAML::Node(YAML::NodeType::Map);
    node.reset(next);
  }
  node = value;
}

}  // namespace orthodyn
