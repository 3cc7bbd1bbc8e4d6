// Latin hypercube sampling (McKay, Beckman, Conover 1979): in each dimension, each of n strata of [0, 1) contains
// exactly one of the n points. A seed gives the same points on every platform.
#pragma once

#include <cstddef>
#include <vector>

namespace orthodyn {

// (stratum + u) / strata with u in [0, 1). The result is below 1 even where rounding would give 1.
double position_in(std::size_t stratum, double u, std::size_t strata);

// Coordinates in [0, 1), indexed by point, then by dimension.
std::vector<std::vector<double>> latin_hypercube(int points, int dimensions, long seed);

}  // namespace orthodyn
