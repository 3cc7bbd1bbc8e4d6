// A factor in time, for loads and for the motion of supports. One kind per file, chosen by `type`.
#pragma once

#include <memory>
#include <vector>

#include "lib/config/registry.h"
#include "lib/ode/step_limits.h"

namespace orthodyn {

class TimeFunction {
 public:
  virtual ~TimeFunction() = default;
  virtual double value(double t) const = 0;
  virtual double rate(double t) const = 0;       // 1/s; at a jump, from the right
  virtual double curvature(double t) const = 0;  // 1/s^2, likewise
  virtual bool constant() const { return false; }
  virtual std::vector<double> kinks() const { return {}; }  // where it is not smooth
  virtual bool has_continuous_rate() const { return kinks().empty(); }
  // A copy whose rate and curvature are accurate between two times, s; null if those of this function are exact.
  virtual std::shared_ptr<const TimeFunction> over(double /*start*/, double /*end*/) const { return nullptr; }
  // What it does between the kinks.
  virtual StepLimits step_limits(double /*start*/, double /*end*/) const { return {}; }
  // The largest magnitude it reaches between two times, or ever: for default scales of errors.
  virtual double peak(double start, double end) const = 0;
  // s, in which the peak would have the impulse of the whole: the integral of its magnitude over the peak, about.
  double seconds_at_peak(double start, double end) const;
};

// The times of `all` within (start, end).
std::vector<double> times_between(const std::vector<double>& all, double start, double end);

}  // namespace orthodyn
