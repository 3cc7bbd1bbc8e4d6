// Headings of the columns of measured tables: "z [mm]".
#pragma once

#include <string>

#include "lib/config/spec.h"

namespace orthodyn::study::fit {

// "mm" of "z [mm]"; "" without brackets.
std::string unit_in(const std::string& heading);
// "z" of "z [mm]".
std::string name_in(const std::string& heading);

// Factor from `unit` to `si`; 1 for "". Throws ConfigError at `origin` if the unit has another dimension.
double factor_of(const std::string& unit, const std::string& si, const SourceLocation& origin);

}  // namespace orthodyn::study::fit
