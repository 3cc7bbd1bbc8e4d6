#include "lib/core/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

namespace orthodyn {

namespace {

struct Document {
  std::string file;
  YAML::Node root;
  std::set<std::string> overridden;  // paths given by --set
  std::set<std::string> filled;      // paths of defaults: they stand on no line
};

std::string mark_text(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return file;
  return fmt::format("{}:{}:{}", file, mark.line + 1, mark.column + 1);
}

// yaml-cpp keeps duplicate keys and ignores merge keys in silence; an alias may contain itself.
class StructureCheck {
 public:
  explicit StructureCheck(const std::string& file) : file_(file) {}

  void visit(const YAML::Node& node, int depth) {
    if (++visited_ > 1'000'000 || depth > 100)
      fail(node, "nested too deeply (an alias that contains itself?)");
    if (node.IsSequence())
      for (const auto& child : node) visit(child, depth + 1);
    if (node.IsMap()) visit_map(node, depth);
  }

 private:
  void visit_map(const YAML::Node& node, int depth) {
    std::set<std::string> seen;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key must be a plain word");
      const std::string key = entry.first.Scalar();
      if (key == "<<") fail(entry.first, "merge keys (<<) are not supported; write the keys out");
      if (!seen.insert(key).second)
        fail(entry.first, fmt::format("key '{}' stands twice in the same section; keep one", key));
      visit(entry.second, depth + 1);
    }
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& message) const {
    throw ConfigError(mark_text(file_, node.Mark()) + ": " + message);
  }

  std::string file_;
  long visited_ = 0;
};

YAML::Node parse(const std::string& text, const std::string& file) {
  try {
    auto documents = YAML::LoadAll(text);
    if (documents.empty()) throw ConfigError(file + ": the file is empty");
    if (documents.size() > 1)
      throw ConfigError(file + ": more than one YAML document; keep what stands before '---'");
    StructureCheck(file).visit(documents[0], 0);
    return documents[0];
  } catch (const YAML::Exception& e) {
    throw ConfigError(
        fmt::format("{}: not YAML: {}", mark_text(file, e.mark), e.msg));
  }
}

std::string read_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ec;
  if (!fs::exists(path, ec)) throw ConfigError(path + ": no such file");
  if (fs::is_directory(path, ec)) throw ConfigError(path + ": is a folder, expected a YAML file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigError(path + ": cannot be opened for reading");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool parse_number(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  return ec == std::errc{} && end == text.data() + text.size();
}

// yaml-cpp makes a map of a scalar and a null of a missing entry; we want to be asked first.
bool parse_index(const std::string& text, std::size_t& index) {
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), index);
  return ec == std::errc{} && end == text.data() + text.size();
}

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

// How often `node` stands below `root`; an alias repeats it, and writing to one place writes to all.
int occurrences(const YAML::Node& root, const YAML::Node& node) {
  int count = root.is(node) ? 1 : 0;
  if (root.IsSequence())
    for (const auto& child : root) count += occurrences(child, node);
  if (root.IsMap())
    for (const auto& entry : root) count += occurrences(entry.second, node);
  return count;
}

std::string child_path(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

// Of a list or a section, for writing: a missing key is made.
YAML::Node entry(YAML::Node& parent, const std::string& step, const std::string& path,
                 const std::string& origin) {
  if (parent.IsMap() || parent.IsNull()) return parent[step];
  if (!parent.IsSequence())
    throw ConfigError(fmt::format("{}: there is nothing below '{}', which is a value", origin,
                                  path.substr(0, path.size() - step.size() - 1)));
  std::size_t index = 0;
  if (!parse_index(step, index) || index >= parent.size())
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

Config Config::from_file(const std::string& path) { return from_text(read_file(path), path); }

Config Config::from_text(const std::string& text, const std::string& name) {
  auto document = std::make_shared<Document>();
  document->file = name;
  document->root = parse(text, name);
  return Config(std::make_shared<Place>(Place{document, document->root, ""}));
}

void Config::override_with(const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string origin = fmt::format("--set {}", assignment);
  const auto steps = split(assignment.substr(0, equals) + ".", '.');
  if (equals == std::string::npos || std::count(steps.begin(), steps.end(), "") > 0 ||
      assignment.find_first_not_of(' ', equals + 1) == std::string::npos)
    throw ConfigError(origin + ": expected PATH=VALUE, such as integrator.rtol=1e-5");
  const YAML::Node value = parse(assignment.substr(equals + 1) + "\n", origin);

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
  const std::string mark = mark_text(document.file, place_->node.Mark());
  return place_->path.empty() ? mark : mark + ": " + place_->path;
}

std::string Config::path() const { return place_->path; }
std::string Config::file() const { return place_->document->file; }

std::string Config::file_path() const {
  namespace fs = std::filesystem;
  const fs::path given(text());
  if (given.is_absolute()) return given.string();
  return (fs::path(place_->document->file).parent_path() / given).string();
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

std::string nearest_name(const std::string& name, const std::vector<std::string>& names) {
  const auto distance = [&](const std::string& other) {
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), 0u);
    for (std::size_t i = 1; i <= name.size(); ++i) {
      std::size_t diagonal = row[0]++;
      for (std::size_t j = 1; j <= other.size(); ++j) {
        const std::size_t substitute = diagonal + (name[i - 1] != other[j - 1]);
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
      }
    }
    return row.back();
  };
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const auto& other : names)
    if (const auto d = distance(other); d < best_distance) best_distance = d, best = other;
  return best;
}

std::string join(const std::vector<std::string>& names, const std::string& separator) {
  return fmt::format("{}", fmt::join(names, separator));
}

}  // namespace orthodyn
