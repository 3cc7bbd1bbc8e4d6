#include "lib/config/yaml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "lib/config/yaml_typos.h"
#include "lib/core/errors.h"
#include "lib/core/file_kind.h"
#include "lib/core/utf8.h"

namespace orthodyn {

namespace {

constexpr std::size_t kMostBytes = 64'000'000;
constexpr int kMostDepth = 100;

// A first pass that requires a single document of bounded depth. yaml-cpp alone would read endless documents if text
// follows a flow collection ("{a: 1},").
class BoundsCheck : public YAML::EventHandler {
 public:
  BoundsCheck(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    refuse_typo_near(text_, file_, mark);
    throw ConfigError(mark_text(file_, mark), "more than one YAML document; keep only what is before this place");
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapEnd() override { --depth_; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}

  int documents() const { return documents_; }

 private:
  void descend(const YAML::Mark& mark) {
    if (++depth_ > kMostDepth) throw ConfigError(mark_text(file_, mark), "nested too deeply");
  }

  const std::string& text_;
  std::string file_;
  int documents_ = 0, depth_ = 0;
};

// Replaces \r\n and \r by \n. yaml-cpp reads a single \r as a blank.
std::string with_plain_line_ends(const std::string& text) {
  if (text.find('\r') == std::string::npos) return text;
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') out += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n') out += '\n';
  }
  return out;
}

void require_bounds(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  BoundsCheck bounds(text, file);
  while (parser.HandleNextDocument(bounds)) {
  }
  if (bounds.documents() == 0) throw ConfigError(file + ":1:1", "the file is empty");
}

// Refuses what yaml-cpp accepts silently: duplicate keys, merge keys, aliases that contain themselves.
class StructureCheck {
 public:
  explicit StructureCheck(const std::string& file) : file_(file) {}

  void visit(const YAML::Node& node, int depth) {
    if (++visited_ > 1'000'000 || depth > kMostDepth) fail(node, "nested too deeply (an alias that contains itself?)");
    if (const std::string& tag = node.Tag(); tag.size() > 1 && tag[0] == '!')
      fail(node, fmt::format("the tag {} is not supported; to read another file write the key `include: FILE`", tag));
    if (node.IsScalar()) require_utf8(node);
    if (node.IsSequence())
      for (const auto& child : node) visit(child, depth + 1);
    if (node.IsMap()) visit_map(node, depth);
  }

 private:
  void visit_map(const YAML::Node& node, int depth) {
    std::set<std::string> seen;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key must be a plain word");
      require_utf8(entry.first);
      const std::string key = entry.first.Scalar();
      if (key == "<<") fail(entry.first, "merge keys (<<) are not supported; write the keys out");
      if (is_key_with_value(entry.first, entry.second)) fail(entry.first, missing_space(key).substr(2));
      if (!seen.insert(key).second)
        fail(entry.first, fmt::format("key '{}' occurs twice in the same section; keep one", key));
      visit(entry.second, depth + 1);
    }
  }

  void require_utf8(const YAML::Node& node) const {
    const std::size_t at = find_invalid_utf8(node.Scalar());
    if (at != std::string::npos)
      fail(node, fmt::format("the byte 0x{:02X} is not UTF-8; save the file in UTF-8",
                             static_cast<unsigned char>(node.Scalar()[at])));
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& message) const {
    throw ConfigError(mark_text(file_, node.Mark()), message);
  }

  std::string file_;
  long visited_ = 0;
};

// Merges other files into sections with the key `include`.
class Inclusion {
 public:
  explicit Inclusion(const YAML::Node& root) : root_(root) {}

  // Changes the node; returns the files of the values that were added.
  Origins resolve(YAML::Node node, const std::string& path, const std::string& file) {
    Origins origins;
    for (const auto& [key, child] : children(node)) origins.merge(resolve(child, child_path(path, key), file));
    if (!node.IsMap() || !node[kKey].IsDefined()) return origins;
    const YAML::Node named = node[kKey];
    if (occurrences(root_, node) > 1)
      fail(named, file, "the section is used in several places through an alias; write it out");
    node.remove(kKey);
    if (named.IsScalar()) join(node, path, file, named, origins);
    else if (!named.IsSequence()) fail(named, file, "expected a file, or a list of files");
    else
      for (std::size_t i = named.size(); i-- > 0;) join(node, path, file, named[i], origins);
    return origins;
  }

 private:
  static constexpr const char* kKey = "include";

  [[noreturn]] static void fail(const YAML::Node& node, const std::string& file, const std::string& message) {
    throw ConfigError(fmt::format("{}: {}", mark_text(file, node.Mark()), kKey), message);
  }

  static std::vector<std::pair<std::string, YAML::Node>> children(const YAML::Node& node) {
    std::vector<std::pair<std::string, YAML::Node>> out;
    if (node.IsMap())
      for (const auto& entry : node) out.emplace_back(entry.first.Scalar(), entry.second);
    if (node.IsSequence())
      for (std::size_t i = 0; i < node.size(); ++i) out.emplace_back(std::to_string(i), node[i]);
    return out;
  }

  void join(YAML::Node& node, const std::string& path, const std::string& file, const YAML::Node& named,
            Origins& origins) {
    namespace fs = std::filesystem;
    if (!named.IsScalar()) fail(named, file, "expected the name of a file");
    const std::string other = (fs::path(file).parent_path() / named.Scalar()).string();
    if (!is_file(other)) fail(named, file, "no such file: " + other);
    const std::string identity = fs::weakly_canonical(other).string();
    if (std::find(open_.begin(), open_.end(), identity) != open_.end()) fail(named, file, other + " includes itself");
    open_.push_back(identity);
    const YAML::Node content = parse_yaml(read_yaml_file(other), other);
    if (!content.IsMap()) fail(named, file, other + " is not a section of keys");
    const YAML::Node outer = root_;
    root_.reset(content);
    const Origins theirs = resolve(content, path, other);
    root_.reset(outer);
    open_.pop_back();
    add_missing(node, content, path, other, theirs, origins);
  }

  static void add_missing(YAML::Node into, const YAML::Node& from, const std::string& path, const std::string& file,
                          const Origins& theirs, Origins& origins) {
    for (const auto& [key, child] : children(from)) {
      const YAML::Node& own = into;
      const std::string place = child_path(path, key);
      if (!own[key].IsDefined()) {
        into[key] = child;
        origins[place] = file;
        for (auto it = theirs.lower_bound(place); it != theirs.end() && it->first.starts_with(place); ++it)
          if (it->first == place || it->first[place.size()] == '.') origins[it->first] = it->second;
      } else if (own[key].IsMap() && child.IsMap()) {
        add_missing(into[key], child, place, file, theirs, origins);
      }
    }
  }

  YAML::Node root_;                // of the file being read
  std::vector<std::string> open_;  // files being read, outermost first
};

}  // namespace

std::string mark_text(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return file;
  return fmt::format("{}:{}:{}", file, mark.line + 1, mark.column + 1);
}

std::string read_yaml_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ec;
  if (!fs::exists(path, ec)) throw ConfigError(path, "no such file");
  if (fs::is_directory(path, ec)) throw ConfigError(path, "is a folder, expected a YAML file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigError(path, "cannot be opened for reading");
  std::string text;
  std::array<char, 65536> piece;
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMostBytes)
      throw ConfigError(path, fmt::format("is larger than {} MB, expected a YAML file", kMostBytes / 1'000'000));
  }
  return text;
}

YAML::Node parse_yaml(const std::string& given, const std::string& file) {
  const std::string text = with_plain_line_ends(given);
  try {
    require_bounds(text, file);
    const YAML::Node root = YAML::Load(text);
    StructureCheck(file).visit(root, 0);
    return root;
  } catch (const YAML::Exception& e) {
    refuse_typo_near(text, file, e.mark);
    refuse_open_bracket(text, file, e.mark);
    throw ConfigError(mark_text(file, e.mark), "not YAML: " + e.msg);
  }
}

std::string child_path(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

int occurrences(const YAML::Node& root, const YAML::Node& node) {
  int count = root.is(node) ? 1 : 0;
  if (root.IsSequence())
    for (const auto& child : root) count += occurrences(child, node);
  if (root.IsMap())
    for (const auto& entry : root) count += occurrences(entry.second, node);
  return count;
}

Origins resolve_includes(YAML::Node root, const std::string& file) { return Inclusion(root).resolve(root, "", file); }

}  // namespace orthodyn
