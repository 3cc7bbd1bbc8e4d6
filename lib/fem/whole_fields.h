// Fields on the nodes of a whole mesh, from the ranks that own these.
#pragma once

#include <vector>

#include "lib/fem/subdomain.h"

namespace orthodyn {

// `here`: so many numbers for each node of this rank. `nodes`: of the whole mesh. Collective.
std::vector<double> on_all_nodes(const Subdomain& subdomain, const std::vector<double>& here, std::size_t components,
                                 std::size_t nodes);

}  // namespace orthodyn
