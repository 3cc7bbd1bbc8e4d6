// Writes lines of numbers and words, for mesh files in text form.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "lib/core/types.h"

namespace orthodyn {

// Node indices (from 0) to be written as numbers from 1.
struct FromOne {
  std::span<const int> indices;
};

// Writes real numbers with the fewest digits that read back as the same number.
class TextLines {
 public:
  // `between` separates the items of a line.
  explicit TextLines(std::string_view between = " ") : between_(between) {}

  // Writes one line. Items: numbers, words, Vec3, FromOne, spans of int or double.
  template <class... Items>
  void line(const Items&... items) {
    (add(items), ...);
    end_line();
  }

  void add(std::string_view word);
  void add(double x);
  void add(std::integral auto n) { add_integer(static_cast<std::int64_t>(n)); }
  void add(const Vec3& x) { add(std::span<const double>(x.data(), 3)); }
  void add(FromOne nodes);
  void add(std::span<const int> numbers);
  void add(std::span<const double> numbers);
  void end_line();

  // Appends the text unchanged. Precondition: no unfinished line.
  void text(std::string_view text) { text_ += text; }

  std::string take() { return std::move(text_); }

 private:
  void add_integer(std::int64_t n);
  void separate();

  std::string between_, text_;
  bool begun_ = false;  // the current line has an item
};

}  // namespace orthodyn
