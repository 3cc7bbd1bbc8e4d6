// Latin hypercube sampling (McKay, Beckman, Conover 1979): in each dimension every one of n strata of [0, 1) has
// exactly one of the n points. The same everywhere for a seed.
#pragma once

#include <cstddef>
#include <vector>

namespace orthodyn {

// At u in [0, 1) of a stratum, in [0, 1): the sum of the last stratum and u may round to 1.
double share_in(std::size_t stratum, double u, std::size_t strata);

// By point, then dimension.
std::vector<std::vector<double>> latin_hypercube(int points, int dimensions, long seed);

}  // namespace orthodyn
