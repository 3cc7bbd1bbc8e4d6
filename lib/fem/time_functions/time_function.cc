#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

std::vector<double> times_between(const std::vector<double>& all, double start, double end) {
  std::vector<double> times;
  for (const double t : all)
    if (t > start && t < end) times.push_back(t);
  return times;
}

}  // namespace orthodyn
