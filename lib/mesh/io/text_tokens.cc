#include "lib/mesh/io/text_tokens.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "lib/core/parse_number.h"

namespace orthodyn {

std::string read_text_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw ConfigError(path, fmt::format("cannot be opened: {}", error.message()));
  if (!std::filesystem::is_regular_file(status)) {  // a pipe might never end
    throw ConfigError(path, "is a directory or device; expected a mesh file");
  }
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
  if (size < 0) throw ConfigError(path, fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  stream.read(text.data(), size);
  if (!stream) throw ConfigError(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  return text;
}

std::string in_capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

TextTokens::TextTokens(std::string path, std::string_view text, Punctuation punctuation)
    : path_(std::move(path)), text_(text), punctuation_(punctuation) {
  skip_blank_lines();
}

bool TextTokens::is_blank(char c) const {
  return c == ' ' || c == '\t' || c == '\r' || (c == ',' && punctuation_.commas);
}

bool TextTokens::at_comment(std::size_t position) const {
  return !punctuation_.comment.empty() && text_.substr(position).starts_with(punctuation_.comment);
}

char TextTokens::peek() {
  while (!at_end() && is_blank(text_[position_])) ++position_;
  return at_end() || text_[position_] == '\n' || at_comment(position_) ? '\0' : text_[position_];
}

std::string_view TextTokens::word(const char* what) {
  if (at_end()) fail("the file ends where {} is expected; is it truncated?", what);
  peek();
  const std::size_t begin = position_;
  while (!at_end() && !at_comment(begin) && text_[position_] != '\n' && !is_blank(text_[position_])) ++position_;
  if (position_ == begin) fail("expected {}, found the end of the line", what);
  return text_.substr(begin, position_ - begin);
}

std::int64_t TextTokens::integer(const char* what) {
  const std::string_view found = word(what);
  std::int64_t value = 0;
  if (!parse_number(found, value)) fail("expected {} (an integer), found {}", what, quoted(found));
  return value;
}

std::int64_t TextTokens::count(const char* what) {
  const std::int64_t found = integer(what);
  if (found < 0) fail("{} is {}; it cannot be negative", what, found);
  return found;
}

double TextTokens::real(const char* what) {
  const std::string_view found = word(what);
  double value = 0;
  if (!parse_number(found, value) || !std::isfinite(value))
    fail("expected {} (a finite number), found {}", what, quoted(found));
  return value;
}

std::string_view TextTokens::rest_of_line() const {
  const std::string_view rest = text_.substr(position_);
  return rest.substr(0, std::min(rest.find('\n'), rest.size()));
}

void TextTokens::finish_line() {
  if (peek() != '\0') fail("expected the end of the line, found {}", quoted(word("a word")));
  skip_line();
}

void TextTokens::skip_line() {
  position_ = std::min(text_.find('\n', position_), text_.size());
  skip_blank_lines();
}

void TextTokens::skip_blank_lines() {
  std::size_t p = position_;
  int line = line_;
  while (p < text_.size() && (is_blank(text_[p]) || text_[p] == '\n' || at_comment(p))) {
    if (at_comment(p)) {
      p = std::min(text_.find('\n', p), text_.size());
      continue;
    }
    line += text_[p] == '\n';
    ++p;
  }
  // At the end of the file, messages refer to the last non-blank line.
  if (p < text_.size()) line_ = line;
  position_ = p;
}

void TextTokens::skip_bytes(std::size_t bytes) {
  const std::size_t end = position_ + std::min(bytes, text_.size() - position_);
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(position_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  position_ = end;
  skip_blank_lines();
}

std::string TextTokens::quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string shown(word.substr(0, kLongest));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "\"" + shown + (word.size() > kLongest ? "..." : "") + "\"";
}

}  // namespace orthodyn
