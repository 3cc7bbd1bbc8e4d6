#include "lib/linear/memory_check.h"

#include <fmt/format.h>

#include "lib/core/errors.h"
#include "lib/core/memory.h"

namespace orthodyn {

void require_memory_for_factor(std::size_t bytes, const std::string& what, const std::string& remedy) {
  constexpr double kAlways = 64e6;  // not worth a look at the system
  constexpr double kGigabyte = 1e9;
  const auto needed = static_cast<double>(bytes);
  if (needed < kAlways) return;
  if (const double left = memory_left(); needed > left)
    throw RunError(
        fmt::format("{} does not fit in memory: it takes {:.3g} GB, and {:.3g} GB are left (of {:.3g} GB that "
                    "the process may use); {}",
                    what, needed / kGigabyte, left / kGigabyte, memory_limit() / kGigabyte, remedy),
        Reason::out_of_memory);
}

}  // namespace orthodyn
