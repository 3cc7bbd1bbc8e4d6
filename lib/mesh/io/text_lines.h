// Lines of numbers and words, of which most mesh files consist.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "lib/core/types.h"

namespace orthodyn {

// Indices of nodes that become numbers from 1 on.
struct FromOne {
  std::span<const int> indices;
};

// Real numbers are written with as many digits as it takes to read the same number again.
class TextLines {
 public:
  // `between` stands between the items of a line.
  explicit TextLines(std::string_view between = " ") : between_(between) {}

  // One line of numbers, words, and several numbers at once (Vec3, FromOne, span of int or double).
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

  // As it is; a line that was begun must have been ended.
  void text(std::string_view text) { text_ += text; }

  std::string take() { return std::move(text_); }

 private:
  void add_integer(std::int64_t n);
  void separate();

  std::string between_, text_;
  bool begun_ = false;  // the line holds something
};

}  // namespace orthodyn
