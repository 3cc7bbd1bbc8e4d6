// Finds risks of locking that an estimate of the mesh error misses: if all elements are too stiff alike, their stresses
// agree between neighbours but are all wrong.
#pragma once

#include <string>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// A sentence about the risk, with a remedy; "" if no risk is found. If the error was estimated by recovered stresses,
// looks for cells much wider than thick (if quadratic, only where the body bends), and for materials that are nearly
// incompressible or far stiffer along one direction than in shear, and for bodies of one layer of hexahedra or wedges.
// If it was estimated by finer elements, looks only for the latter materials, in which finer elements lock, too. Checks
// the elements of this rank only.
std::string locking_risk(const FemModel& model, const State& state, bool by_finer_elements);

}  // namespace orthodyn
