// Limits of adaptive steps, so that no step misses a short change of a time function, such as a pulse after a long
// rest, which no error test would detect. Time is divided into parts over which the function is close to a cubic; a
// step is at most as long as the shortest part that it enters.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace orthodyn {

class StepLimits {
 public:
  // No limit.
  StepLimits() = default;
  // The same limit (s) at all times.
  explicit StepLimits(double longest) : longest_(longest) {}
  // Limits from samples of `function` between two times (s). The function is smooth except at `kinks`, where steps end
  // anyway. It may throw ConfigError at times at which it has no value.
  static StepLimits of(const std::function<double(double)>& function, double start, double end,
                       const std::vector<double>& kinks);

  // Adds further limits; both apply.
  void add(const StepLimits& other);

  // Latest allowed end (s) of a step that starts at t (s); infinite if there is no limit.
  double latest_end(double t) const;

  // The ends of all parts, s.
  std::vector<double> ends() const;

  // A time (s) at which a function changes by more than a hundredth of its range within the shortest part, other than
  // at a kink. Empty if there is no such time.
  std::optional<double> unresolved() const { return unresolved_; }
  // Largest number of parts.
  static constexpr int kMostParts = 1 << 14;

 private:
  using Grid = std::vector<double>;  // ends of the parts, ascending

  void add_smooth_span(const std::function<double(double)>& function, double start, double end, int most_parts);

  double longest_ = std::numeric_limits<double>::infinity();
  std::vector<Grid> grids_;
  std::optional<double> unresolved_;
};

}  // namespace orthodyn
