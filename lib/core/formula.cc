#include "lib/core/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lib/core/versions.h"

namespace orthodyn {

namespace {

const bool version_registered =
    library_versions().emplace("muParser", mu::Parser().GetVersion(mu::pviBRIEF)).second;

}  // namespace

struct PointFormula::Parsed {
  mutable Vec3 x = Vec3::Ones();  // where muParser looks the variables up
  mu::Parser parser;
};

PointFormula::PointFormula(const std::string& text, std::string where) : text_(text), where_(std::move(where)) {
  auto parsed = std::make_shared<Parsed>();
  try {
    auto& parser = parsed->parser;
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    const char* const names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) parser.DefineVar(names[i], &parsed->x[i]);
    parser.SetExpr(text);
    parser.Eval();
  } catch (const mu::Parser::exception_type& e) {
    throw std::invalid_argument(e.GetMsg());
  }
  parsed_ = std::move(parsed);
}

double PointFormula::at(const Vec3& x) const {
  parsed_->x = x;
  double value = std::nan("");
  try {
    value = parsed_->parser.Eval();
  } catch (const mu::Parser::exception_type&) {  // no std::exception; the value stays what it is
  }
  if (std::isfinite(value)) return value;
  throw ConfigError(fmt::format("{}: '{}' is {} at x = {}, y = {}, z = {}", where_, text_, value, x[0], x[1], x[2]));
}

PointFormula Value<PointFormula>::read(const Config& c, const Rule&) {
  try {
    return PointFormula(c.text(), c.where());
  } catch (const std::invalid_argument& e) {
    c.fail(fmt::format("cannot read the formula {}: {} Known: x, y, z, pi, e, and functions such as sin, exp, sqrt.",
                       c.shown(), e.what()));
  }
}

}  // namespace orthodyn
