// Messages of the library name options of the program; in Python they are arguments.
#pragma once

#include <string>

namespace orthodyn::python {

// "use --force to replace it" as "use force=True to replace it".
std::string in_python(std::string message);

}  // namespace orthodyn::python
