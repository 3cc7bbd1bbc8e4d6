// What an estimate of the mesh's error may not see: cells and laws for which elements lock, all in the same way, so
// that stresses agree from one to the next and are wrong together.
#pragma once

#include <string>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// In words, with what to do; "" where nothing is found. Of an estimate by recovered stresses: cells that are much wider
// than thick where the body bends; laws that are nearly incompressible, or far stiffer in one way than in another. Of
// one by finer elements the last, where they gain too little for an estimate. Of the elements of this rank.
std::string blind_spot(const FemModel& model, const State& state, bool by_finer_elements);

}  // namespace orthodyn
