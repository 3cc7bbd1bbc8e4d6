// Intervals by profile likelihood: the two values of a parameter at which chi-square, minimised over all others, is
// 3.84 above its minimum (the 95 % quantile of chi-square with one degree of freedom; Venzon & Moolgavkar 1988, Applied
// Statistics 37, 87). Unlike linearised intervals they may be asymmetric, and do not depend on the coordinate.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/study/fit/statistics.h"

namespace orthodyn::study::fit {

struct ProfileEnd {
  std::optional<double> value;  // SI; of a parameter that stays within its bounds at this end, the bound
  bool is_open = false;         // chi-square stays below the limit up to `value`
  std::string failure;          // why there is no value
};

struct ProfileInterval {
  std::size_t parameter = 0;
  ProfileEnd low, high;
  double least_chi_square = 0;  // found on the way
};

// The intervals of the single parameters. The rise of chi-square is 3.84 times the squared NoiseTest::factor. Each end
// takes a few searches over the other parameters, from the linearised estimate. A Poisson's ratio is fixed by its
// position in its stable interval. Throws Interrupted.
std::vector<ProfileInterval> profiles_of(const Problem& problem, const Fit& fit, const Search& best,
                                         const Statistics& statistics, const JobOptions& options,
                                         const std::function<void(const std::string& stage)>& on_stage);

}  // namespace orthodyn::study::fit
