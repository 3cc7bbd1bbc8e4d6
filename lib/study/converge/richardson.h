// The limit of values on meshes that are refined by one ratio, from the last of them (Richardson; Roache 1998,
// Verification and Validation in Computational Science and Engineering, ch. 5).
#pragma once

#include <optional>
#include <vector>

namespace orthodyn::study::converge {

struct Extrapolation {
  double limit = 0;
  double uncertainty = 0;       // of the limit, absolute: 1.25 times its distance from the finest value
  std::optional<double> order;  // observed on the last three values; none of values that are the same
};

// `values` from coarse to fine, each mesh `ratio` times as fine as the one before. The observed order is taken from 1/2
// to `highest`. None for fewer than three values, and for values whose last two steps do not show an order of at least
// 1/2: they may be far from any limit, or have none.
std::optional<Extrapolation> extrapolate(const std::vector<double>& values, double ratio, double highest);

}  // namespace orthodyn::study::converge
