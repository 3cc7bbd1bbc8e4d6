// A formula of the input, such as "105*sin(pi*y/12)": muParser's syntax, the constants pi and e, and
// the coordinates x, y, z of a point in m. The only door to muParser.
#pragma once

#include <memory>
#include <string>

#include "lib/core/types.h"
#include "lib/core/values.h"

namespace orthodyn {

class PointFormula {
 public:
  PointFormula() : PointFormula("0") {}
  // Throws std::invalid_argument with muParser's complaint.
  explicit PointFormula(const std::string& text, std::string where = "");

  // Throws ConfigError where the value is not a number. Not to be called by two threads at once.
  double at(const Vec3& x) const;
  const std::string& text() const { return text_; }

 private:
  struct Parsed;
  std::string text_, where_;  // and its place in the input
  std::shared_ptr<const Parsed> parsed_;
};

template <>
struct Value<PointFormula> {
  static Shape shape() {
    return {.kind = Shape::Kind::either,
            .words = "formula of x, y, z",
            .items = {Value<double>::shape(), Value<std::string>::shape()}};
  }
  static PointFormula read(const Config& c, const Rule&);
  static std::string yaml(const PointFormula& f) { return f.text(); }
};

}  // namespace orthodyn
