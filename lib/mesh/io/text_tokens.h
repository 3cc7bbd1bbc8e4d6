// Reads words and numbers of a text file line by line; error messages contain the line.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

// The content of a file. Throws ConfigError if it is missing, unreadable, or not a regular file (a pipe might never
// end).
std::string read_text_file(const std::string& path);

// Upper case, for keywords and names that are compared regardless of case.
std::string in_capitals(std::string text);

struct Punctuation {
  bool commas = false;            // commas separate words, as blanks do
  std::string_view comment = {};  // at the start of a word, it makes the rest of the line a comment
};

// Between calls the cursor is on a non-blank line or at the end of the file. Lines end with \n or \r\n. The text must
// outlive the tokens. Functions that read throw ConfigError if the text does not match.
class TextTokens {
 public:
  TextTokens(std::string path, std::string_view text, Punctuation punctuation = {});

  bool at_end() const { return position_ == text_.size(); }
  int line() const { return line_; }
  const std::string& path() const { return path_; }

  // The next non-blank character of this line; '\0' at its end.
  char peek();

  // The next word of this line. `what` says in messages what was expected.
  std::string_view word(const char* what);
  std::int64_t integer(const char* what);
  std::int64_t count(const char* what);  // >= 0
  double real(const char* what);         // finite

  // The rest of this line; does not move the cursor.
  std::string_view rest_of_line() const;

  // The bytes from the cursor to the end of the file, for binary sections.
  std::string_view rest_of_file() const { return text_.substr(position_); }

  // Moves the cursor forward, for binary sections; counts the skipped lines.
  void skip_bytes(std::size_t bytes);

  void finish_line();  // fails unless the rest of the line is blank
  void skip_line();

  // Throws ConfigError "path:line: message", for the current line or for `line`.
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
    fail_at(line_, message, std::forward<Args>(args)...);
  }
  template <class... Args>
  [[noreturn]] void fail_at(int line, fmt::format_string<Args...> message, Args&&... args) const {
    throw ConfigError(fmt::format("{}:{}", path_, line), fmt::format(message, std::forward<Args>(args)...));
  }

  // For messages: the word in quotes, shortened to 40 characters, unprintable bytes as '?'.
  static std::string quoted(std::string_view word);

 private:
  bool is_blank(char c) const;
  bool at_comment(std::size_t position) const;
  void skip_blank_lines();

  std::string path_;
  std::string_view text_;
  Punctuation punctuation_;
  std::size_t position_ = 0;
  int line_ = 1;
};

}  // namespace orthodyn
