// A time function: the dimensionless factor of loads and support motions. The key `type` chooses it.
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
  virtual double rate(double t) const = 0;       // 1/s; right-hand value at a jump
  virtual double curvature(double t) const = 0;  // 1/s^2; right-hand value at a jump
  virtual bool constant() const { return false; }
  // True for a factor of `analysis: harmonic`, whose value() depends on the part, see kRealPart.
  virtual bool is_harmonic() const { return false; }
  virtual std::vector<double> kinks() const { return {}; }  // times at which the function is not smooth, s
  virtual bool has_continuous_rate() const { return kinks().empty(); }
  // Returns a copy whose rate and curvature are accurate from start to end (s), or null if this function's rate and
  // curvature already are.
  virtual std::shared_ptr<const TimeFunction> over(double /*start*/, double /*end*/) const { return nullptr; }
  // Step limits between the kinks, from start to end (s).
  virtual StepLimits step_limits(double /*start*/, double /*end*/) const { return {}; }
  // Largest magnitude from start to end (s); some types return the largest at any time. Used for default error scales.
  virtual double peak(double start, double end) const = 0;
  // Equivalent duration (s), approximately: the integral of the magnitude from start to end divided by peak().
  double seconds_at_peak(double start, double end) const;
};

// A harmonic analysis evaluates loads at three times, which stand for the parts of the complex amplitude: at kRealPart
// and kImaginaryPart, a harmonic factor is the real and the imaginary part; at kSteadyPart, it is zero.
inline constexpr double kSteadyPart = 0, kRealPart = 1, kImaginaryPart = 2;

// The times in `all` that lie in the open interval (start, end).
std::vector<double> times_between(const std::vector<double>& all, double start, double end);

}  // namespace orthodyn
