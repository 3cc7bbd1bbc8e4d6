// Latin hypercube sampling (McKay, Beckman, Conover 1979): in each dimension every one of n strata of [0, 1) has
// exactly one of the n points. The same everywhere for a seed.
#pragma once

#include <vector>

namespace orthodyn {

// By point, then dimension.
std::vector<std::vector<double>> latin_hypercube(int points, int dimensions, long seed);

}  // namespace orthodyn
