#include "lib/ode/step_limits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr int kLeast = 6;             // sampling intervals in the shortest part
constexpr double kClose = 0.01;       // tolerance of a cubic, relative to the variation within the part
constexpr double kNegligible = 1e-4;  // lower bound of that tolerance, relative to the whole range
constexpr double kJump = 0.01;        // unresolved variation in the shortest part, relative to the range
constexpr double kKink = 1e-3;        // excess change between two samples, relative to the range

// Divides samples into parts over which they are close to a cubic, by bisection.
class Parts {
 public:
  explicit Parts(std::vector<double> samples) : f_(std::move(samples)) {
    constexpr double kRoundOff = 256 * std::numeric_limits<double>::epsilon() / kNegligible;
    double largest = 0;
    for (const double f : f_) largest = std::max(largest, std::abs(f));
    range_ = std::max(variation(0, f_.size() - 1), kRoundOff * largest);
  }

  // Indices of the ends of the parts, ascending.
  std::vector<std::size_t> ends() {
    std::vector<std::size_t> ends{0};
    divide(0, f_.size() - 1, ends);
    return ends;
  }
  std::optional<std::size_t> unresolved() const { return unresolved_; }

 private:
  double variation(std::size_t first, std::size_t last) const {
    const auto [least, largest] = std::minmax_element(f_.begin() + static_cast<std::ptrdiff_t>(first),
                                                      f_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    return *largest - *least;
  }

  void divide(std::size_t first, std::size_t last, std::vector<std::size_t>& ends) {
    if (is_close_to_a_cubic(first, last)) return ends.push_back(last);
    if (last - first == kLeast) {
      if (!unresolved_ && variation(first, last) > kJump * range_ && is_more_than_a_kink(first, last))
        unresolved_ = (first + last) / 2;
      return ends.push_back(last);
    }
    const std::size_t middle = (first + last) / 2;
    divide(first, middle, ends);
    divide(middle, last, ends);
  }

  double change(std::size_t i) const { return f_[i + 1] - f_[i]; }

  // At a simple kink, the change between two samples lies between the changes before and after it.
  bool is_more_than_a_kink(std::size_t first, std::size_t last) const {
    for (std::size_t i = first > 0 ? first - 1 : first; i <= last && i + 1 < f_.size(); ++i) {
      const double before = change(i > 0 ? i - 1 : i + 1), after = change(i + 2 < f_.size() ? i + 1 : i - 1);
      const double beyond = std::max(std::min(before, after) - change(i), change(i) - std::max(before, after));
      if (beyond > kKink * range_) return true;
    }
    return false;
  }

  // Compares with the cubic through four equidistant samples.
  bool is_close_to_a_cubic(std::size_t first, std::size_t last) const {
    const std::size_t third = (last - first) / 3;
    const double f0 = f_[first], f1 = f_[first + third], f2 = f_[first + 2 * third], f3 = f_[last];
    const double d1 = f1 - f0, d2 = f2 - 2 * f1 + f0, d3 = f3 - 3 * f2 + 3 * f1 - f0;
    const double allowed = std::max(kClose * variation(first, last), kNegligible * range_);
    for (std::size_t i = first; i <= last; ++i) {
      const double s = static_cast<double>(i - first) / static_cast<double>(third);
      const double cubic = f0 + s * (d1 + (s - 1) / 2 * (d2 + (s - 2) / 3 * d3));  // Newton's form
      if (!(std::abs(f_[i] - cubic) <= allowed)) return false;
    }
    return true;
  }

  std::vector<double> f_;
  double range_;
  std::optional<std::size_t> unresolved_;
};

}  // namespace

StepLimits StepLimits::of(const std::function<double(double)>& function, double start, double end,
                          const std::vector<double>& kinks) {
  StepLimits limits;
  std::vector<double> ends;
  for (const double t : kinks)
    if (t > start && t < end) ends.push_back(t);
  std::sort(ends.begin(), ends.end());
  ends.push_back(end);
  for (double from = start; const double to : ends) {
    if (!(to > from)) continue;
    const auto share = static_cast<unsigned>(kMostParts * (to - from) / (end - start));
    limits.add_smooth_span(function, from, to, static_cast<int>(std::bit_ceil(std::max(share, 32u))));
    from = to;
  }
  return limits;
}

// Takes samples slightly inside the span, because the values at its ends may belong to the adjacent spans.
void StepLimits::add_smooth_span(const std::function<double(double)>& function, double start, double end,
                                 int most_parts) {
  constexpr double kInset = 1e-9;
  const int intervals = kLeast * most_parts;
  const auto time = [&](std::size_t i) {
    return start + (end - start) * std::clamp(static_cast<double>(i) / intervals, kInset, 1 - kInset);
  };
  std::vector<double> samples(static_cast<std::size_t>(intervals) + 1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    try {
      samples[i] = function(time(i));
    } catch (const ConfigError&) {  // the run reports the error if it reaches this time
      samples[i] = i > 0 ? samples[i - 1] : 0;
    }
  }
  Parts parts(std::move(samples));
  const auto all = parts.ends();
  if (const auto i = parts.unresolved(); i && !unresolved_) unresolved_ = time(*i);
  if (all.size() == 2) return;
  Grid& grid = grids_.emplace_back();
  for (const std::size_t i : all) grid.push_back(start + (end - start) * (static_cast<double>(i) / intervals));
}

std::vector<double> StepLimits::ends() const {
  std::vector<double> all;
  for (const Grid& grid : grids_) all.insert(all.end(), grid.begin(), grid.end());
  return all;
}

void StepLimits::add(const StepLimits& other) {
  longest_ = std::min(longest_, other.longest_);
  grids_.insert(grids_.end(), other.grids_.begin(), other.grids_.end());
  if (!unresolved_) unresolved_ = other.unresolved_;
}

double StepLimits::latest_end(double t) const {
  double latest = t + longest_;
  for (const Grid& grid : grids_) {
    const auto next = std::upper_bound(grid.begin(), grid.end(), t);
    for (auto part = next == grid.begin() ? next + 1 : next; part < grid.end() && *(part - 1) < latest; ++part)
      latest = std::min(latest, std::max(*(part - 1), t + (*part - *(part - 1))));
  }
  return latest;
}

}  // namespace orthodyn
