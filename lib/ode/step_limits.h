// How long steps may be so that none passes over what a force or a motion does as a function of time alone, where no
// error test would see it: a short pulse after a long rest. The span of time is divided into parts over each of which
// the function is close to a cubic; a step is at most as long as the shortest part that it enters.
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
  // The same for all times, s.
  explicit StepLimits(double longest) : longest_(longest) {}
  // From samples of `function` between two times, s, where it is smooth but for `kinks`, at which steps end anyhow. It
  // may throw ConfigError where it has no value.
  static StepLimits of(const std::function<double(double)>& function, double start, double end,
                       const std::vector<double>& kinks);

  // Both limits hold from now on.
  void add(const StepLimits& other);

  // The latest end of a step that begins at t; infinite where there is no limit.
  double latest_end(double t) const;

  // The ends of all parts, s.
  std::vector<double> ends() const;

  // Where a function changes by more than a hundredth of its range within the shortest part, if it does, and by more
  // than a kink: s.
  std::optional<double> unresolved() const { return unresolved_; }
  // As many parts are told apart.
  static constexpr int kMostParts = 1 << 14;

 private:
  using Grid = std::vector<double>;  // the ends of the parts, ascending

  void add_smooth_span(const std::function<double(double)>& function, double start, double end, int most_parts);

  double longest_ = std::numeric_limits<double>::infinity();
  std::vector<Grid> grids_;
  std::optional<double> unresolved_;
};

}  // namespace orthodyn
