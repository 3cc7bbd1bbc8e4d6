#include "lib/fem/time_functions/time_function.h"

#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"

namespace orthodyn {

std::vector<double> times_between(const std::vector<double>& all, double start, double end) {
  std::vector<double> times;
  for (const double t : all)
    if (t > start && t < end) times.push_back(t);
  return times;
}

double TimeFunction::seconds_at_peak(double start, double end) const {
  constexpr std::size_t kSamples = 2048, kFewest = 8;  // samples in total; fewest per smooth part
  if (constant()) return end - start;
  const double largest = peak(start, end);
  if (!(largest > 0)) return 0;
  std::vector<double> ends = times_between(kinks(), start, end);
  for (const double t : times_between(step_limits(start, end).ends(), start, end)) ends.push_back(t);
  ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  const auto samples = static_cast<int>(std::max(kSamples / ends.size(), kFewest));
  double sum = 0, begin = start;
  for (const double part_end : ends) {
    const double length = part_end - begin;
    for (int k = 0; k < samples; ++k) {
      try {
        sum += length / samples * std::abs(value(begin + length * golden_ratio_sample(k)));
      } catch (const ConfigError&) {  // no value at this time; the run reports this if it reaches the time
      }
    }
    begin = part_end;
  }
  return sum / largest;
}

}  // namespace orthodyn
