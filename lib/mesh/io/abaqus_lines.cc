#include "lib/mesh/io/abaqus_lines.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "lib/core/errors.h"
#include "lib/core/parse_number.h"
#include "lib/core/spelling.h"

namespace orthodyn {
namespace {

constexpr int kMaxIncludeDepth = 20, kMaxIncludedFiles = 1000;

std::string_view stripped(std::string_view text) {
  const auto is_edge = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_edge(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_edge(text.back())) text.remove_suffix(1);
  return text;
}

// The next comma outside quotes, or the end. An unclosed quote is an ordinary character.
std::size_t next_comma(std::string_view line) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == ',') return k;
    if (line[k] != '"') continue;
    const std::size_t close = line.find('"', k + 1);
    if (close == std::string_view::npos) return std::min(line.find(',', k), line.size());
    k = close;
  }
  return line.size();
}

void append_fields(std::string_view line, std::vector<std::string_view>& fields) {
  for (;;) {
    const std::size_t comma = next_comma(line);
    fields.push_back(stripped(line.substr(0, comma)));
    if (comma == line.size()) return;
    line.remove_prefix(comma + 1);
  }
}

bool is_include(std::string_view line) {
  return abaqus_word(line.substr(0, std::min(line.find(','), line.size()))) == "*INCLUDE";
}

}  // namespace

std::string abaqus_word(std::string_view text) {
  std::string word = in_capitals(std::string(text));
  std::erase_if(word, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return word;
}

std::optional<double> abaqus_number(std::string_view field) {
  double value = 0;
  if (field.empty()) return value;
  if (!parse_number(field, value)) {
    std::string with_e(field);
    std::replace_if(
        with_e.begin(), with_e.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
    if (!parse_number(std::string_view(with_e), value)) return std::nullopt;
  }
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool abaqus_is_name(std::string_view field) {
  return !field.empty() && (std::isalpha(static_cast<unsigned char>(field[0])) || field[0] == '_');
}

AbaqusLines::AbaqusLines(MeshDraft& draft, std::string_view text)
    : draft_(draft), folder_(std::filesystem::path(draft.files.front()).parent_path().string()) {
  sources_.push_back({{draft.files.front(), text, {.comment = "**"}}, 0, false});
  place_.line = sources_.back().tokens.line();
}

// Enters files at *INCLUDE and leaves them at their end.
void AbaqusLines::follow_includes() {
  for (;;) {
    Source& top = sources_.back();
    if (top.tokens.at_end()) {
      if (sources_.size() == 1) return;
      const bool only_data = top.only_data;
      sources_.pop_back();
      if (!only_data) continue;
      follow_includes();
      if (at_end() || sources_.back().tokens.peek() == '*') return;
      place_ = {sources_.back().tokens.line(), sources_.back().file};
      fail("data lines after a keyword with INPUT=; put them into that file, or remove INPUT=");
    }
    if (top.tokens.peek() != '*') return;
    if (top.only_data) {
      place_ = {top.tokens.line(), top.file};
      fail(
          "a keyword in a file named by INPUT=, which may contain data lines only; use *INCLUDE, INPUT= for this file");
    }
    if (!is_include(top.tokens.rest_of_line())) return;
    const AbaqusKeyword include = take_keyword();
    if (include.parameter("INPUT").empty()) fail("*INCLUDE without INPUT=file");
    open(include.parameter("INPUT"), include, false);
  }
}

bool AbaqusLines::at_keyword() {
  follow_includes();
  return at_end() || sources_.back().tokens.peek() == '*';
}

bool AbaqusLines::at_end() {
  return std::all_of(sources_.begin(), sources_.end(), [](const Source& source) { return source.tokens.at_end(); });
}

AbaqusKeyword AbaqusLines::keyword() {
  AbaqusKeyword keyword = take_keyword();
  if (keyword.is_read && keyword.has("INPUT")) open(keyword.parameter("INPUT"), keyword, true);
  return keyword;
}

// A keyword line that ends with a comma continues on the next line.
AbaqusKeyword AbaqusLines::take_keyword() {
  TextTokens& tokens = sources_.back().tokens;
  place_ = {tokens.line(), sources_.back().file};
  AbaqusKeyword keyword{.place = place_};
  std::vector<std::string_view> fields;
  append_fields(tokens.rest_of_line(), fields);
  tokens.skip_line();
  while (fields.size() > 1 && fields.back().empty() && !tokens.at_end() && tokens.peek() != '*') {
    fields.pop_back();
    append_fields(tokens.rest_of_line(), fields);
    tokens.skip_line();
  }
  keyword.name = abaqus_word(fields[0].substr(1));
  keyword.spelled = "*" + in_capitals(std::string(stripped(fields[0].substr(1))));
  for (std::size_t k = 1; k < fields.size(); ++k) {
    if (fields[k].empty()) continue;
    const std::size_t equals = std::min(fields[k].find('='), fields[k].size());
    const std::string_view value = equals < fields[k].size() ? stripped(fields[k].substr(equals + 1)) : "";
    const std::string name = abaqus_word(fields[k].substr(0, equals));
    if (!keyword.parameters.emplace(name, value).second) fail("{}: {} is given twice", keyword.spelled, name);
  }
  keyword.is_read = check_abaqus_parameters(keyword, [&](const std::string& message) { fail("{}", message); });
  return keyword;
}

void AbaqusLines::open(const std::string& file, const AbaqusKeyword& keyword, bool only_data) {
  const std::string path = (std::filesystem::path(folder_) / file).string();
  if (sources_.size() > kMaxIncludeDepth || ++opened_ > kMaxIncludedFiles)
    fail("{}, INPUT={}: more than {} included files, or nested more than {} deep; does a file include itself?",
         keyword.spelled, TextTokens::quoted(file), kMaxIncludedFiles, kMaxIncludeDepth);
  auto found = texts_.find(path);
  if (found == texts_.end()) {
    std::string text;
    try {
      text = read_text_file(path);
    } catch (const ConfigError& error) {
      fail("{}, INPUT={}: {}", keyword.spelled, TextTokens::quoted(file), error.what());
    }
    draft_.files.push_back(path);
    found = texts_.emplace(path, std::pair(static_cast<int>(draft_.files.size()) - 1, std::move(text))).first;
  }
  sources_.push_back({{path, found->second.second, {.comment = "**"}}, found->second.first, only_data});
}

const std::vector<std::string_view>& AbaqusLines::data() {
  TextTokens& tokens = sources_.back().tokens;
  place_ = {tokens.line(), sources_.back().file};
  fields_.clear();
  append_fields(tokens.rest_of_line(), fields_);
  while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
  tokens.skip_line();
  return fields_;
}

void AbaqusLines::skip_data() {
  while (!at_keyword()) sources_.back().tokens.skip_line();
}

std::int64_t AbaqusLines::integer(std::string_view field, const char* what) const {
  std::int64_t value = 0;
  if (!parse_number(field, value))
    fail("expected {} (an integer), found {}", what, field.empty() ? "nothing" : TextTokens::quoted(field));
  return value;
}

double AbaqusLines::real(std::size_t field, const char* what) const {
  if (field >= fields_.size()) return 0;
  const std::optional<double> value = abaqus_number(fields_[field]);
  if (!value) fail("expected {} (a finite number), found {}", what, TextTokens::quoted(fields_[field]));
  return *value;
}

void AbaqusLines::enter(const Mark& mark) {
  left_.push_back(std::move(sources_));
  sources_ = mark;
}

void AbaqusLines::leave() {
  sources_ = std::move(left_.back());
  left_.pop_back();
}

std::string AbaqusLines::name_of(const AbaqusKeyword& keyword, const char* parameter) const {
  const std::string name = keyword.parameter(parameter);
  if (name.empty()) fail("{} without {}=name", keyword.spelled, parameter);
  return name;
}

std::string AbaqusLines::choice(const AbaqusKeyword& keyword, const char* parameter,
                                const std::vector<std::string>& values) const {
  const std::string given = abaqus_word(keyword.parameter(parameter));
  if (given.empty()) return values.front();
  for (const std::string& value : values)
    if (abaqus_word(value).starts_with(given)) return value;
  fail("{}, {}={} is not supported; supported: {}", keyword.spelled, parameter,
       TextTokens::quoted(keyword.parameter(parameter)), join(values));
}

}  // namespace orthodyn
