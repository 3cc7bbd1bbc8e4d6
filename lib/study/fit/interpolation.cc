#include "lib/study/fit/interpolation.h"

#include <algorithm>

namespace orthodyn::study::fit {

Stencil stencil_at(const std::vector<double>& times, double t) {
  constexpr std::ptrdiff_t kPoints = 6;
  const auto count = std::min(kPoints, std::ssize(times));
  const auto above = std::lower_bound(times.begin(), times.end(), t) - times.begin();
  const auto first = std::clamp(above - count / 2, std::ptrdiff_t{0}, std::ssize(times) - count);
  Stencil out{static_cast<std::size_t>(first), {}, {}};
  const auto time = [&](std::ptrdiff_t k) { return times[static_cast<std::size_t>(first + k)]; };
  // product of (t - t_m) / (t_j - t_m) over all m but j and `left_out`
  const auto product = [&](std::ptrdiff_t j, std::ptrdiff_t left_out) {
    double out_of = 1;
    for (std::ptrdiff_t m = 0; m < count; ++m)
      if (m != j && m != left_out) out_of *= (t - time(m)) / (time(j) - time(m));
    return out_of;
  };
  for (std::ptrdiff_t j = 0; j < count; ++j) {
    out.weights.push_back(product(j, j));
    double slope = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i)
      if (i != j) slope += product(j, i) / (time(j) - time(i));
    out.slopes.push_back(slope);
  }
  return out;
}

}  // namespace orthodyn::study::fit
