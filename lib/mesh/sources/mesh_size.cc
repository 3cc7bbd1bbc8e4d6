// Implements check_mesh_size().
#include <fmt/format.h>

#include "lib/core/memory.h"
#include "lib/mesh/sources/source_keys.h"

namespace orthodyn {

namespace {
constexpr double kMaxElements = 5e8;
// A lower bound that covers mesh and model without integrator and factorisation (docs/decisions.md).
constexpr double kBytesPerElement = 600;
}  // namespace

void check_mesh_size(double elements, const Config& cells) {
  if (elements > kMaxElements)
    cells.fail(fmt::format("{:.2g} elements; at most {:.0e} are allowed; use fewer cells", elements, kMaxElements));
  const double needed = kBytesPerElement * elements, limit = memory_limit();
  if (needed > limit)
    cells.fail(fmt::format(
        "{:.2g} elements need at least {:.2g} GB of memory, but only {:.2g} GB are available; use fewer cells",
        elements, needed / 1e9, limit / 1e9));
}

}  // namespace orthodyn
