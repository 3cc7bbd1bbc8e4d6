// A value of a quantity that is named elsewhere: a number in its SI unit, or with a unit of its own ("1 mJ"), which is
// checked when the quantity is known.
#pragma once

#include <string>

#include "lib/config/spec.h"

namespace orthodyn {

// What stands in lists of keys as the unit of such values.
inline constexpr std::string_view kUnitOfQuantity = "unit of the quantity";

class Measured {
 public:
  Measured(double si = 0, std::string unit = "") : si_(si), unit_(std::move(unit)) {}

  double si() const { return si_; }
  operator double() const { return si_; }

  // Throws ConfigError at `origin` unless the unit that was given measures what `si_unit` does; "" and "1" are none.
  void require(const std::string& si_unit, const SourceLocation& origin) const;

 private:
  double si_;
  std::string unit_;  // "" if none was given
};

template <>
struct Value<Measured> {
  static ValueSchema schema() { return Value<double>::schema(); }
  static Measured read(const Config& c, const Rule& r);
  static std::string yaml(const Measured& x) { return number_text(x.si()); }
};

}  // namespace orthodyn
