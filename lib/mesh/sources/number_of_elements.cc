#include "lib/mesh/sources/number_of_elements.h"

#include <fmt/format.h>

#include "lib/core/memory.h"

namespace orthodyn {

namespace {
constexpr double kMostElements = 5e8;
// Mesh and model with no integrator and no factorisation (docs/decisions.md): any use needs more.
constexpr double kBytesPerElement = 600;
}  // namespace

void require_room(double elements, const Config& cells) {
  if (elements > kMostElements)
    cells.fail(fmt::format("{:.2g} elements, the most is {:.0e}; use fewer cells", elements, kMostElements));
  const double needed = kBytesPerElement * elements, limit = memory_limit();
  if (needed > limit)
    cells.fail(
        fmt::format("{:.2g} elements need at least {:.2g} GB of memory, and there are {:.2g} GB; use fewer cells",
                    elements, needed / 1e9, limit / 1e9));
}

}  // namespace orthodyn
