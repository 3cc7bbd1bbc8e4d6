#include "lib/config/point_quantity.h"

#include <cctype>

#include "lib/core/units.h"

namespace orthodyn {

namespace {

// "12 kPa", "3 furlongs": a number and a word, which is meant as a unit where it is no formula.
bool has_unit(const std::string& text) {
  const auto parts = split_quantity(text);
  return parts && std::isalpha(static_cast<unsigned char>(parts->unit[0]));
}

}  // namespace

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
