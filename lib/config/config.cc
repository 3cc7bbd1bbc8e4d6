#include "lib/config/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "lib/config/yaml_document.h"
#include "lib/core/parse_number.h"
#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

// By path: keys that set() created, with the names of the other keys of the section.
using CreatedKeys = std::map<std::string, std::vector<std::string>>;

// ".0" for the path "mesh.cells.0" and the top "mesh.cells"; none if `path` is neither `top` nor below it.
std::optional<std::string> rest_below(const std::string& path, const std::string& top) {
  if (!path.starts_with(top) || (path.size() > top.size() && path[top.size()] != '.')) return {};
  return path.substr(top.size());
}

// Records the first key along `path` that does not exist yet, for spelling suggestions: it may be a typing error.
void record_created(CreatedKeys& created, YAML::Node node, const std::string& base, const std::string& path) {
  std::istringstream steps(path);
  std::string reached = base;
  for (std::string step; std::getline(steps, step, '.') && node.IsMap();) {
    reached = child_path(reached, step);
    const YAML::Node& section = node;  // const: operator[] must not create the key
    const YAML::Node next = section[step];
    if (!next.IsDefined()) {
      for (const auto& entry : section) created[reached].push_back(entry.first.Scalar());
      return;
    }
    node.reset(next);
  }
}

}  // namespace

struct Config::Document {
  std::string file;
  YAML::Node root;
  bool records_defaults = false;
  Origins included;                        // file of origin of values that were included
  std::map<std::string, std::string> set;  // by path: origin of each value written by set(), or ""
  CreatedKeys created = {};                // keys created by set()
  std::map<std::string, std::pair<YAML::Node, std::string>> files;  // by path: values that name files
  std::vector<std::string> warnings = {};
  std::map<std::string, std::string> former = {};  // by path: keys under which renamed ones were parsed
};

namespace {

// Whether a section has keys that are all indices of a list.
bool has_indices(const Config& at) {
  const auto is_index = [](const std::string& key) { return key.find_first_not_of("0123456789") == std::string::npos; };
  return at.is_map() && at.size() > 0 && std::ranges::all_of(at.keys(), is_index);
}

}  // namespace

struct Config::Place {
  std::shared_ptr<Document> document;
  YAML::Node node;
  YAML::Node parsed;  // the node as parsed, which knows its line; undefined for a default
  std::string path;

  // Writes below this place. `origin`: place for error messages; `source`: the place given by the caller, or "".
  void write(const std::string& below, const YAML::Node& value, const std::string& origin,
             const std::string& source) const {
    record_created(document->created, node, path, below);
    write_at(document->root, node, below, value, origin);
    const std::string whole = child_path(path, below);
    std::erase_if(document->set, [&](const auto& entry) { return rest_below(entry.first, whole).has_value(); });
    document->set[whole] = source;
  }
};

Config::Config(std::shared_ptr<const Place> place) : place_(std::move(place)) {}

Config Config::from_file(const std::string& path) { return from_text(read_yaml_file(path), path); }

Config Config::from_text(const std::string& text, const std::string& name) {
  auto document = std::make_shared<Document>();
  document->file = name;
  document->root = parse_yaml(text, name);
  document->included = resolve_includes(document->root, name);
  return Config(std::make_shared<Place>(Place{document, document->root, document->root, ""}));
}

Config Config::copy() const { return copy(false); }

Config Config::resolving() const { return place_->document->records_defaults ? *this : copy(true); }

Config Config::copy(bool resolving) const {
  const Document& original = *place_->document;
  auto document = std::make_shared<Document>(Document{
      original.file, YAML::Clone(place_->node), resolving, original.included, original.set, original.created, {}});
  return Config(std::make_shared<Place>(Place{document, document->root, place_->parsed, place_->path}));
}

void Config::set(const std::string& path, const ConfigValue& value, const std::string& place) {
  place_->write(path, node_of(value), place.empty() ? "--set " + path : place, place);
}

void Config::set(const std::string& path, const Config& value, const std::string& place) {
  YAML::Node copy = YAML::Clone(value.place_->node);
  put_on_one_line(copy);
  place_->write(path, copy, place.empty() ? "--set " + path : place, place);
}

void Config::set_yaml(const std::string& path, const std::string& yaml, const std::string& place) {
  const std::string origin = place.empty() ? fmt::format("--set {}={}", path, yaml) : place;
  place_->write(path, parse_yaml(yaml + "\n", origin), origin, place);
}

void Config::override_with(const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string path = "." + assignment.substr(0, equals) + ".";
  if (equals == std::string::npos || path.find("..") != std::string::npos ||
      assignment.find_first_not_of(' ', equals + 1) == std::string::npos)
    throw ConfigError("--set " + assignment, "expected PATH=VALUE, such as integrator.rtol=1e-5", InputFault::form);
  set_yaml(assignment.substr(0, equals), assignment.substr(equals + 1));
}

bool Config::is_map() const { return place_->node.IsMap(); }
bool Config::is_sequence() const { return place_->node.IsSequence(); }
bool Config::is_scalar() const { return place_->node.IsScalar(); }
bool Config::is_null() const { return place_->node.IsNull(); }
std::size_t Config::size() const { return place_->node.size(); }

template <class Step>
Config Config::child(const Step& step, const std::string& name) const {
  const YAML::Node &node = place_->node, &parsed = place_->parsed;  // const: operator[] must not create the key
  const bool has_lines = parsed.IsDefined() && (parsed.IsMap() || parsed.IsSequence());
  const std::string path = child_path(place_->path, name);
  const auto former = place_->document->former.find(path);
  const auto parsed_child = [&] {
    if (!has_lines) return YAML::Node(YAML::NodeType::Undefined);
    return former == place_->document->former.end() ? parsed[step] : parsed[former->second];
  };
  return Config(std::make_shared<Place>(Place{place_->document, node[step], parsed_child(), path}));
}

Config Config::at(std::size_t index) const { return child(index, std::to_string(index)); }

Config Config::at(const std::string& key) const { return child(key, key); }

std::vector<std::string> Config::keys() const {
  std::vector<std::string> names;
  for (const auto& entry : place_->node) names.push_back(entry.first.Scalar());
  return names;
}

bool Config::has(const std::string& key) const {
  const YAML::Node& node = place_->node;  // const: operator[] must not create the key
  return node.IsMap() && node[key].IsDefined();
}

// yaml-cpp tags quoted scalars by "!".
bool Config::is_quoted() const { return is_scalar() && place_->node.Tag() == "!"; }

bool Config::reads_as_number() const {
  double value = 0;
  return is_scalar() && !is_quoted() && parse_number(place_->node.Scalar(), value);
}

double Config::number() const {
  double value = 0;
  if (is_quoted() && parse_number(place_->node.Scalar(), value))
    fail(fmt::format("expected a number, found the text {}: remove the quotes", shown()), InputFault::form);
  if (!is_scalar() || !parse_number(place_->node.Scalar(), value)) fail_expected("a number");
  if (!std::isfinite(value)) fail_expected("a finite number");
  return value;
}

long Config::integer() const {
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > 9e15) fail_expected("a whole number");
  return static_cast<long>(value);
}

bool Config::boolean() const {
  const std::string value = is_scalar() ? place_->node.Scalar() : "";
  if (is_quoted() && (value == "true" || value == "false"))
    fail(fmt::format("expected true or false, found the text {}: remove the quotes", shown()), InputFault::form);
  if (value == "true") return true;
  if (value == "false") return false;
  fail_expected("true or false");
}

std::string Config::text() const {
  if (!is_scalar()) fail_expected("a text");
  return place_->node.Scalar();
}

Config Config::fill(const std::string& key, const std::string& yaml) const {
  assert(place_->document->records_defaults);
  YAML::Node node = place_->node;
  node[key] = YAML::Load(yaml);
  return at(key);
}

Config Config::fill_text(const std::string& key, const std::string& text) const {
  assert(place_->document->records_defaults);
  YAML::Node node = place_->node;
  node[key] = text;
  return at(key);
}

void Config::rename(const std::string& former, const std::string& name) const {
  assert(place_->document->records_defaults);
  YAML::Node node = place_->node;
  place_->document->former[child_path(place_->path, name)] = former;
  node[name] = node[former];
  node.remove(former);
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
  for (auto it = document.set.rbegin(); it != document.set.rend(); ++it)  // deeper paths first
    if (const auto rest = rest_below(place_->path, it->first))
      return it->second.empty() ? fmt::format("{}: --set {}", document.file, place_->path) : it->second + *rest;
  const std::string place = place_->parsed.IsDefined() ? mark_text(file(), place_->parsed.Mark()) : document.file;
  return place_->path.empty() ? place : place + ": " + place_->path;
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
  if (place_->document->records_defaults)
    place_->document->files.insert_or_assign(place_->path, std::pair(place_->node, found));
  return found;
}

std::vector<std::string> Config::file_paths() const {
  std::vector<std::string> out;
  for (const auto& [path, file] : place_->document->files) out.push_back(file.second);
  return out;
}

void Config::warn(const std::string& message) const {
  auto& all = place_->document->warnings;
  if (const auto text = where() + ": " + message; std::find(all.begin(), all.end(), text) == all.end())
    all.push_back(text);
}

const std::vector<std::string>& Config::warnings() const { return place_->document->warnings; }

void Config::fail(const std::string& message, InputFault fault) const {
  const auto created = place_->document->created.find(place_->path);
  std::string hint;
  if (created != place_->document->created.end()) {
    const std::string name = place_->path.substr(place_->path.rfind('.') + 1);
    hint = did_you_mean(name, created->second);
    if (!hint.empty()) hint = "; '" + name + "' is a new key" + hint;
  }
  throw ConfigError(where(), message + hint, fault);
}

void Config::fail_expected(const std::string& expected, const std::string& hint) const {
  if (expected.starts_with("a list") && has_indices(*this))  // --set values.5=2 without `values`
    fail(fmt::format("entry {} cannot be changed, because the list itself is not given: write the whole list",
                     join(keys())),
         InputFault::form);
  fail("expected " + expected + ", found " + shown() + hint, InputFault::form);
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
    node =
        folder.empty() ? whole.string() : whole.lexically_proximate(fs::absolute(folder).lexically_normal()).string();
  }
  const std::string text = dump();
  for (auto& [node, value] : before) node = value;
  return text;
}

}  // namespace orthodyn
