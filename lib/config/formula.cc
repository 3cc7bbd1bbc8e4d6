#include "lib/config/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/core/units.h"
#include "lib/core/versions.h"

namespace orthodyn {

namespace {

const bool version_registered = library_versions().emplace("muParser", mu::Parser().GetVersion(mu::pviBRIEF)).second;

// Throws if the text contains a single "=", with which muParser would assign to a variable.
void refuse_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') ++i;
    else if (i == 0 || std::string("<>!").find(text[i - 1]) == std::string::npos)
      throw std::invalid_argument("A formula must not assign a value; to compare, write ==.");
  }
}

void refuse_double_star(const std::string& text) {
  if (text.find("**") != std::string::npos)
    throw std::invalid_argument("A power is written ^, as in sin(t)^2, not **.");
}

// Only some of muParser's messages end with a full stop.
std::string as_sentence(const std::string& message) { return message.ends_with('.') ? message : message + "."; }

// True for a number followed by a word: "12 kPa", "3 furlongs".
bool has_unit(const std::string& text) {
  const auto parts = split_quantity(text);
  return parts && std::isalpha(static_cast<unsigned char>(parts->unit[0]));
}

}  // namespace

struct Formula::Parsed {
  double at(const double* values) const;

  std::vector<std::string> names;
  mutable std::mutex mutex;               // guards `variables` and `parser`, which keeps its stack between calls
  mutable std::vector<double> variables;  // read by muParser
  mu::Parser parser;
};

double Formula::Parsed::at(const double* values) const {
  const std::lock_guard lock(mutex);
  std::copy_n(values, variables.size(), variables.begin());
  try {
    return parser.Eval();
  } catch (const mu::Parser::exception_type&) {  // not a std::exception
    return std::nan("");
  }
}

Formula::Formula(const std::string& text, const std::vector<std::string>& variables, std::string where)
    : text_(text), where_(std::move(where)) {
  auto parsed = std::make_shared<Parsed>();
  parsed->names = variables;
  parsed->variables.assign(variables.size(), 1);
  try {
    auto& parser = parsed->parser;
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &parsed->variables[i]);
    refuse_assignment(text);
    refuse_double_star(text);
    parser.SetExpr(text);
    parser.Eval();
    if (parser.GetNumResults() > 1) throw std::invalid_argument("A comma separates two values; write a decimal point.");
  } catch (const mu::Parser::exception_type& e) {
    throw std::invalid_argument(as_sentence(e.GetMsg()));
  }
  parsed_ = std::move(parsed);
}

bool Formula::uses(const std::string& variable) const {
  const std::lock_guard lock(parsed_->mutex);
  return parsed_->parser.GetUsedVar().contains(variable);
}

double Formula::evaluate(const double* values) const {
  const double value = parsed_->at(values);
  if (std::isfinite(value)) return value;
  std::vector<std::string> place;
  for (std::size_t i = 0; i < parsed_->names.size(); ++i)
    place.push_back(fmt::format("{} = {}", parsed_->names[i], values[i]));
  throw ConfigError(
      where_, fmt::format("'{}' is {} at {}", text_, std::isnan(value) ? "not a number" : "infinite", join(place)));
}

namespace {

// The value of "0.4 mm" in SI units; empty if the text is not a number with a known unit.
std::optional<double> in_si(const std::string& text) {
  const auto quantity = split_quantity(text);
  if (!quantity) return {};
  try {
    return quantity->number * si_factor(quantity->unit);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

}  // namespace

void fail_formula(const Config& c, const std::string& known, const std::string& complaint) {
  if (const auto si = c.is_scalar() ? in_si(c.text()) : std::nullopt)
    c.fail(fmt::format("{} has a unit, but this value may be a formula, which is in SI units: write {:.6g}", c.shown(),
                       *si));
  c.fail(fmt::format("cannot read the formula {}: {} Known: {}, pi, e, and functions such as sin, exp, sqrt.",
                     c.shown(), complaint, known));
}

ValueSchema Value<PointQuantity>::schema() {
  return {.kind = ValueSchema::Kind::either,
          .words = std::string("number or formula of ") + PointFormula::kVariables,
          .items = {Value<double>::schema(), Value<std::string>::schema()}};
}

PointQuantity Value<PointQuantity>::read(const Config& c, const Rule& r) {
  if (!c.is_scalar() || c.reads_as_number()) return read_number(c, r);
  try {
    return PointQuantity(PointFormula(c.text(), c.where()));
  } catch (const std::invalid_argument& e) {
    if (has_unit(c.text())) return read_number(c, r);
    fail_formula(c, PointFormula::kVariables, e.what());
  }
}

}  // namespace orthodyn
