// Numbers and durations as text for people.
#pragma once

#include <string>

namespace orthodyn {

// `value` with the digits that its relative error leaves certain and one more: at least two, at most seven. Seven if
// the error is zero or not finite. 324.487 with a relative error of 0.3 is "320".
std::string known_digits(double value, double relative_error);

// "59 s", "2 min 0 s", "1.5 h": rounded to seconds, or to tenths of an hour for one hour and more.
std::string duration_text(double seconds);

}  // namespace orthodyn
