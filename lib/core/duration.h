// A span of time, for people.
#pragma once

#include <string>

namespace orthodyn {

// "59 s", "2 min 0 s", "1.5 h"; to whole seconds, and from an hour on to its tenths.
std::string duration_text(double seconds);

}  // namespace orthodyn
