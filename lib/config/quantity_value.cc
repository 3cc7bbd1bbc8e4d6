#include "lib/config/quantity_value.h"

#include <stdexcept>

#include "lib/core/units.h"

namespace orthodyn {

void QuantityValue::require(const std::string& si_unit, const SourceLocation& origin) const {
  if (unit_.empty()) return;
  try {
    check_dimension(unit_, si_unit.empty() ? "1" : si_unit);
  } catch (const std::invalid_argument& e) {
    origin.fail(e.what());
  }
}

QuantityValue Value<QuantityValue>::read(const Config& c, const Rule& r) {
  const auto parts = c.is_scalar() && !c.reads_as_number() ? split_quantity(c.text()) : std::nullopt;
  QuantityValue out(parts ? 0 : c.number());
  if (parts) {
    try {
      out = {parts->number * si_factor(parts->unit), parts->unit};
    } catch (const std::invalid_argument& e) {
      c.fail(e.what(), InputFault::form);
    }
  }
  if (!r.range.contains(out)) c.fail("must be " + range_text(r.range) + ", found " + c.shown());
  return out;
}

}  // namespace orthodyn
