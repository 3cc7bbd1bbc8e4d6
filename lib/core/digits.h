// Numbers with as many digits as are known of them.
#pragma once

#include <string>

namespace orthodyn {

// A value of which a share may be error: with the digits that it does not touch and one more, at least two and at most
// seven; 324.487 with an error of 0.3 is "320". With seven where the error is not finite.
std::string known_digits(double value, double relative_error);

}  // namespace orthodyn
