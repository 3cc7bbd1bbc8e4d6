// Interpolation of samples by the polynomial of degree 5 through the six nearest ones, with its slope. For a sine with
// n samples per period, the error is about (pi / n)^6 of its amplitude.
#pragma once

#include <cstddef>
#include <vector>

namespace orthodyn::study::fit {

// The value and the slope at a time as weighted sums of the samples first, first + 1, ...
struct Stencil {
  std::size_t first = 0;
  std::vector<double> weights, slopes;
};

// Precondition: at least two times, ascending. Outside of them the polynomial of the outermost samples goes on.
Stencil stencil_at(const std::vector<double>& times, double t);

}  // namespace orthodyn::study::fit
