// The names and paths of a sweep: each must do something, mean one thing in formulas and head one column.
#pragma once

#include "lib/study/sweep.h"

namespace orthodyn {

// Throws ConfigError, with both places where two things clash.
void check_names(const Sweep& sweep);

}  // namespace orthodyn
