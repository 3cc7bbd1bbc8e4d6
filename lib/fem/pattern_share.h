// How the matrices of the ranks' parts of a mesh make up that of the whole.
#pragma once

#include "lib/core/pattern.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/subdomain.h"

namespace orthodyn {

// Points with an unknown are numbered one rank after the other. Collective.
PatternShare share_of(const DofMap& dofs, const Subdomain& subdomain);

}  // namespace orthodyn
