#include "lib/config/yaml_typos.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <sstream>
#include <vector>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr std::size_t kLongestLine = 2000;  // characters searched per line, because std::regex recurses

std::string advice_for(const std::string& key) { return "put a space after '" + key + ":'"; }

// The line without its comment. A " #" within quotes also counts as a comment, which affects only suggestions.
std::string code_of(const std::string& line) {
  const auto begin = line.find_first_not_of(' ');
  if (begin != std::string::npos && line[begin] == '#') return "";
  return line.substr(0, std::min(line.find(" #"), kLongestLine));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(code_of(line));
  return lines;
}

bool is_blank_line(const std::string& line) { return line.find_first_not_of(" \t") == std::string::npos; }

std::size_t indentation(const std::string& line) { return line.find_first_not_of(' '); }

[[noreturn]] void refuse_line(const std::string& file, std::size_t line, std::size_t column, const std::string& what) {
  throw ConfigError(fmt::format("{}:{}:{}", file, line + 1, column + 1), "not YAML: " + what);
}

// Refuses a key without a blank after its colon, at the start of a line, a list entry or an entry in braces.
void refuse_missing_space(const std::string& line, const std::string& file, std::size_t number) {
  static const std::regex key(R"((^ *(- +)*|[{,] *)([A-Za-z_]\w*):(?=[^\s:/]))");
  std::smatch found;
  if (std::regex_search(line, found, key))
    refuse_line(file, number, static_cast<std::size_t>(found.position(3)), advice_for(found.str(3)));
}

bool has_value(const std::string& line) {
  static const std::regex key(R"(^ *(- +)*[A-Za-z_][\w.]*: +[^\s|>&].*)");
  return std::regex_match(line, key);
}

void refuse_indentation(const std::string& line, const std::string& before, const std::string& file,
                        std::size_t number) {
  static const std::regex key(R"(^ *[A-Za-z_][\w.]*:( .*)?)");
  if (line.find_first_not_of(" \t") > line.find('\t'))
    refuse_line(file, number, line.find('\t'), "indent with spaces, not tabs");
  if (std::regex_match(line, key) && has_value(before) && indentation(line) > indentation(before))
    refuse_line(file, number, indentation(line),
                "this line is indented deeper than the one before it, which has a value already; align the two");
}

struct Bracket {
  char kind;
  std::size_t line, column;
};

// Finds brackets outside of quotes, comments and words.
class Brackets {
 public:
  // The first bracket still open at the end of the text, or one closed by a bracket of the other kind.
  std::optional<Bracket> unclosed(const std::string& text) {
    for (std::size_t i = 0, line_start = 0; i < text.size(); ++i) {
      const char c = text[i], before = i > line_start ? text[i - 1] : ' ';
      const bool is_spaced = i + 1 == text.size() || std::string(" \n").find(text[i + 1]) != std::string::npos;
      if (c == '\n') {
        ++line_;
        line_start = i + 1;
        begins_ = true;
      } else if (c == '#' && before == ' ') {
        i = std::min(text.find('\n', i), text.size()) - 1;
      } else if (begins_ && (c == '"' || c == '\'')) {
        i = end_of_quotes(text, i);
        begins_ = false;
      } else if ((c == '[' || c == '{') && (begins_ || !open_.empty())) {
        open_.push_back({c, line_, i - line_start});
        begins_ = true;
      } else if ((c == ']' || c == '}') && !open_.empty()) {
        if ((c == ']') != (open_.back().kind == '[')) return open_.back();
        open_.pop_back();
      } else if (c != ' ') {
        begins_ = c == ',' || ((c == ':' || c == '-') && is_spaced);
      }
    }
    if (open_.empty()) return {};
    return open_.front();
  }

 private:
  std::size_t end_of_quotes(const std::string& text, std::size_t i) {
    const char quote = text[i];
    for (++i; i < text.size() && text[i] != quote; ++i)
      if (text[i] == '\n') ++line_;
      else if (text[i] == '\\' && quote == '"') ++i;
    return i;
  }

  std::vector<Bracket> open_;
  std::size_t line_ = 0;
  bool begins_ = true;  // a word or a bracket may begin here
};

struct ForeignKey {
  const char *name, *here, *hint;  // `here`: the corresponding key of orthodyn, which the section must have
};

constexpr const char* kRatio =
    "; a damping ratio xi at the frequency f (Hz) is stiffness: xi/(pi f), in s, or mass: 4 pi f xi, in 1/s.";

constexpr ForeignKey kForeignKeys[] = {
    {"ratio", "stiffness", kRatio},
    {"damping_ratio", "stiffness", kRatio},
    {"zeta", "stiffness", kRatio},
    {"xi", "stiffness", kRatio},
    {"alpha", "mass", "; Rayleigh's alpha is 'mass', 1/s."},
    {"beta", "mass", "; Rayleigh's beta is 'stiffness', s."},
    {"rho", "density", "; the density is 'density', kg/m^3."},
    {"E", "young", "; Young's modulus is 'young', Pa."},
};

}  // namespace

std::string missing_space(const std::string& text) {
  static const std::regex key(R"(^([A-Za-z_]\w*):[^\s:/].*)");
  std::smatch found;
  const std::string begin = text.substr(0, kLongestLine);
  return std::regex_match(begin, found, key) ? "; " + advice_for(found.str(1)) : "";
}

void refuse_typo_near(const std::string& text, const std::string& file, const YAML::Mark& mark) {
  const auto lines = lines_of(text);
  if (mark.is_null() || lines.empty()) return;
  const std::size_t here = std::min(static_cast<std::size_t>(mark.line), lines.size() - 1);
  std::size_t before = here;
  while (before > 0 && is_blank_line(lines[--before])) {
  }
  refuse_missing_space(lines[before], file, before);
  if (before == here) return;
  refuse_missing_space(lines[here], file, here);
  refuse_indentation(lines[here], lines[before], file, here);
}

void refuse_open_bracket(const std::string& text, const std::string& file, const YAML::Mark& mark) {
  const auto open = Brackets().unclosed(text);
  if (mark.is_null() || !open || open->line > static_cast<std::size_t>(mark.line)) return;
  refuse_line(file, open->line, open->column, fmt::format("this '{}' is not closed", open->kind));
}

bool is_key_with_value(const YAML::Node& key, const YAML::Node& value) {
  if (key.Tag() == "!") return false;  // in quotes
  const std::string& text = key.Scalar();
  const auto colon = text.find(':');
  if (missing_space(text).empty()) return false;
  return value.IsNull() || std::string("[{\"'").find(text[colon + 1]) != std::string::npos;
}

std::string hint_for_foreign_key(const std::string& name, const std::vector<std::string>& known) {
  for (const ForeignKey& key : kForeignKeys)
    if (name == key.name && std::find(known.begin(), known.end(), key.here) != known.end()) return key.hint;
  return "";
}

}  // namespace orthodyn
