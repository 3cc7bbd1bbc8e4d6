#include "lib/mesh/io/text_lines.h"

#include <fmt/format.h>

#include <iterator>

namespace orthodyn {

void TextLines::separate() {
  if (begun_) text_ += between_;
  begun_ = true;
}

void TextLines::add(std::string_view word) {
  separate();
  text_ += word;
}

void TextLines::add(double x) {
  separate();
  fmt::format_to(std::back_inserter(text_), "{}", x);
}

void TextLines::add_integer(std::int64_t n) {
  separate();
  fmt::format_to(std::back_inserter(text_), "{}", n);
}

void TextLines::add(FromOne nodes) {
  for (const int n : nodes.indices) add(n + 1);
}

void TextLines::add(std::span<const int> numbers) {
  for (const int n : numbers) add(n);
}

void TextLines::add(std::span<const double> numbers) {
  for (const double x : numbers) add(x);
}

void TextLines::end_line() {
  text_ += '\n';
  begun_ = false;
}

}  // namespace orthodyn
