#include "lib/config/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "lib/core/parse_number.h"
#include "lib/config/yaml_document.h"

namespace orthodyn {

namespace {

struct Document {
  std::string file;
  YAML::Node root;
  Origins included;                  // what does not stand in `file`
  std::set<std::string> overridden;  // paths given by --set
  std::set<std::string> filled;      // paths of defaults: they stand on no line
  std::map<std::string, std::pair<YAML::Node, std::string>> files;  // by path: values that name files
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

void put_on_one_line(YAML::Node node) {
  if (node.IsMap() || node.IsSequence()) node.SetStyle(YAML::EmitterStyle::Flow);
  for (auto child : node) put_on_one_line(node.IsMap() ? child.second : YAML::Node(child));
}

// Of a list or a section, for writing: a missing key is made.
YAML::Node entry(YAML::Node& parent, const std::string& step, const std::string& path,
                 const std::string& origin) {
  if (parent.IsMap() || parent.IsNull()) return parent[step];
  if (!parent.IsSequence())
    throw ConfigError(fmt::format("{}: there is nothing below '{}', which is a value", origin,
                                  path.substr(0, path.size() - step.size() - 1)));
  std::size_t index = 0;
  if (!parse_number(step, index) || index >= parent.size())
    throw ConfigError(fmt::format("{}: '{}' is not an index below {}", origin, step, parent.size()));
  return parent[index];
}

bool is_at_or_below(const std::string& path, const std::set<std::string>& places) {
  return std::any_of(places.begin(), places.end(), [&](const std::string& place) {
    return path == place || path.starts_with(place + ".");
  });
}

}  // namespace

struct Config::Place {
  std::shared_ptr<Document> document;
  YAML::Node node;
  std::string path;
};

Config::Config(std::shared_ptr<const Place> place) : place_(std::move(place)) {}

Config Config::from_file(const std::string& path) { return from_text(read_yaml_file(path), path); }

Config Config::from_text(const std::string& text, const std::string& name) {
  auto document = std::make_shared<Document>();
  document->file = name;
  document->root = parse_yaml(text, name);
  document->included = resolve_includes(document->root, name);
  return Config(std::make_shared<Place>(Place{document, document->root, ""}));
}

void Config::override_with(const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string origin = fmt::format("--set {}", assignment);
  const auto steps = split(assignment.substr(0, equals) + ".", '.');
  if (equals == std::string::npos || std::count(steps.begin(), steps.end(), "") > 0 ||
      assignment.find_first_not_of(' ', equals + 1) == std::string::npos)
    throw ConfigError(origin + ": expected PATH=VALUE, such as integrator.rtol=1e-5");
  const YAML::Node value = parse_yaml(assignment.substr(equals + 1) + "\n", origin);

  YAML::Node node = place_->document->root;  // a handle: writing through it changes the document
  std::string path;
  for (const auto& step : steps) {
    path = child_path(path, step);
    YAML::Node next = entry(node, step, path, origin);
    if (next.IsDefined() && occurrences(place_->document->root, next) > 1)
      throw ConfigError(
          fmt::format("{}: '{}' stands in several places by an alias; change the file", origin, path));
    const bool last = path.size() == equals;
    if (!last && (!next.IsDefined() || next.IsNull()))
      next = YAML::Node(YAML::NodeType::Map);
    node.reset(next);
  }
  node = value;
  place_->document->overridden.insert(path);
}

bool Config::is_map() const { return place_->node.IsMap(); }
bool Config::is_sequence() const { return place_->node.IsSequence(); }
bool Config::is_scalar() const { return place_->node.IsScalar(); }
bool Config::is_null() const { return place_->node.IsNull(); }
std::size_t Config::size() const { return place_->node.size(); }

Config Config::at(std::size_t index) const {
  const YAML::Node child = place_->node[index];
  return Config(std::make_shared<Place>(
      Place{place_->document, child, child_path(place_->path, std::to_string(index))}));
}

std::vector<std::string> Config::keys() const {
  std::vector<std::string> names;
  for (const auto& entry : place_->node) names.push_back(entry.first.Scalar());
  return names;
}

bool Config::has(const std::string& key) const {
  const YAML::Node& node = place_->node;  // const: operator[] must not create the key
  return node.IsMap() && node[key].IsDefined();
}

Config Config::at(const std::string& key) const {
  const YAML::Node& node = place_->node;
  return Config(
      std::make_shared<Place>(Place{place_->document, node[key], child_path(place_->path, key)}));
}

bool Config::reads_as_number() const {
  double value = 0;
  return is_scalar() && parse_number(place_->node.Scalar(), value);
}

double Config::number() const {
  double value = 0;
  if (!is_scalar() || !parse_number(place_->node.Scalar(), value))
    fail(fmt::format("expected a number, found {}", shown()));
  if (!std::isfinite(value)) fail(fmt::format("expected a finite number, found {}", shown()));
  return value;
}

long Config::integer() const {
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > 9e15)
    fail(fmt::format("expected a whole number, found {}", shown()));
  return static_cast<long>(value);
}

bool Config::boolean() const {
  const std::string value = is_scalar() ? place_->node.Scalar() : "";
  if (value == "true") return true;
  if (value == "false") return false;
  fail(fmt::format("expected true or false, found {}", shown()));
}

std::string Config::text() const {
  if (!is_scalar()) fail(fmt::format("expected a text, found {}", shown()));
  return place_->node.Scalar();
}

Config Config::fill(const std::string& key, const std::string& yaml) const {
  YAML::Node node = place_->node;
  node[key] = YAML::Load(yaml);
  place_->document->filled.insert(child_path(place_->path, key));
  return at(key);
}

Config Config::fill_text(const std::string& key, const std::string& text) const {
  YAML::Node node = place_->node;
  node[key] = text;
  place_->document->filled.insert(child_path(place_->path, key));
  return at(key);
}

std::string Config::shown() const {
  if (is_map()) return "a section of keys";
  if (is_sequence()) return fmt::format("a list of {}", size());
  if (!is_scalar()) return "nothing";
  std::string text = place_->node.Scalar();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return "'" + text + "'";
}

std::string Config::where() const {
  const auto& document = *place_->document;
  if (is_at_or_below(place_->path, document.overridden))
    return fmt::format("{}: --set {}", document.file, place_->path);
  if (is_at_or_below(place_->path, document.filled))
    return fmt::format("{}: {}", document.file, place_->path);
  const std::string mark = mark_text(file(), place_->node.Mark());
  return place_->path.empty() ? mark : mark + ": " + place_->path;
}

std::string Config::path() const { return place_->path; }

std::string Config::file() const {
  const auto& document = *place_->document;
  std::string path = place_->path;
  while (!path.empty()) {
    if (const auto it = document.included.find(path); it != document.included.end()) return it->second;
    const auto dot = path.rfind('.');
    path.resize(dot == std::string::npos ? 0 : dot);
  }
  return document.file;
}

std::string Config::file_path() const {
  namespace fs = std::filesystem;
  const std::string found = (fs::path(file()).parent_path() / text()).string();
  place_->document->files.insert_or_assign(place_->path, std::pair(place_->node, found));
  return found;
}

std::vector<std::string> Config::file_paths() const {
  std::vector<std::string> out;
  for (const auto& [path, file] : place_->document->files) out.push_back(file.second);
  return out;
}

void Config::fail(const std::string& message) const {
  throw ConfigError(where() + ": " + message);
}

std::string Config::yaml() const {
  YAML::Node copy = YAML::Clone(place_->node);
  put_on_one_line(copy);
  YAML::Emitter out;
  out << copy;
  return out.c_str();
}

std::string Config::dump() const {
  YAML::Emitter out;
  out << place_->document->root;
  return std::string(out.c_str()) + "\n";
}

std::string Config::dump_for(const std::string& folder) const {
  namespace fs = std::filesystem;
  std::vector<std::pair<YAML::Node, std::string>> before;
  for (const auto& [path, file] : place_->document->files) {
    before.emplace_back(file.first, file.first.Scalar());
    YAML::Node node = file.first;
    const fs::path whole = fs::absolute(file.second).lexically_normal();  // the folder need not exist yet
    node = folder.empty() ? whole.string() : whole.lexically_proximate(fs::absolute(folder).lexically_normal()).string();
  }
  const std::string text = dump();
  for (auto& [node, value] : before) node = value;
  return text;
}

}  // namespace orthodyn
