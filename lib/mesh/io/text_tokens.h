// Words and numbers of a text file, line by line, with messages that name the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace orthodyn {

// The content of a file. Throws ConfigError for a file that is missing, unreadable, or not a regular file (a pipe
// might never end).
std::string read_text_file(const std::string& path);

// For keywords and names that may be spelled in any case.
std::string in_capitals(std::string text);

// What else than blanks and ends of lines has a meaning.
struct Punctuation {
  bool commas = false;            // separate words, as blanks do
  std::string_view comment = {};  // where a word begins with it, the rest of the line is a comment
};

// Between calls the cursor is on a line that is not blank, or at the end of the file. Lines end
// with \n or \r\n. The text must outlive the tokens. Whatever does not fit throws ConfigError.
class TextTokens {
 public:
  TextTokens(std::string path, std::string_view text, Punctuation punctuation = {});

  bool at_end() const { return position_ == text_.size(); }
  int line() const { return line_; }
  const std::string& path() const { return path_; }

  // The next character of this line that is not blank; '\0' at its end.
  char peek();

  // The next word of this line; `what` is named if there is none or it does not read as a number.
  std::string_view word(const char* what);
  std::int64_t integer(const char* what);
  std::int64_t count(const char* what);  // not negative
  double real(const char* what);         // finite

  // What is left of this line. The cursor stays.
  std::string_view rest_of_line() const;

  // The bytes from the cursor to the end of the file, for binary sections.
  std::string_view rest_of_file() const { return text_.substr(position_); }

  // Goes to a later place in the text; lines between are counted.
  void skip_bytes(std::size_t bytes);

  void finish_line();  // nothing may be left on it
  void skip_line();

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_at(int line, const std::string& message) const;

  // For messages: in quotes, shortened, unprintable bytes as '?'.
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
