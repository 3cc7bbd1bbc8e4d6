// A scalar at the integration points of a region that may change in time: moisture, temperature, activation.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "lib/config/formula.h"
#include "lib/core/types.h"
#include "lib/element/batch.h"
#include "lib/fem/differences.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

// Values and rates (1/s) for batches of elements. Thread-safe: the values at one time are computed once.
class PointValues {
 public:
  struct At {
    std::vector<Batch> value, rate;  // by LawPoint::index
  };

  // `points`: number of integration points of an element.
  explicit PointValues(int points) : points_(points) {}
  virtual ~PointValues() = default;

  std::shared_ptr<const At> at(double t) const;

  virtual bool constant() const = 0;
  virtual std::size_t bytes() const = 0;
  virtual std::vector<double> kinks() const = 0;  // s
  virtual StepLimits step_limits(double start, double end) const = 0;

  // The values with the largest magnitude from `start` to `end` (s), and an equivalent duration (s): the integral of
  // the magnitude divided by its peak. Both are approximate.
  std::shared_ptr<const At> at_peak(double start, double end) const;
  virtual double seconds_at_peak(double start, double end) const = 0;

 protected:
  // Calls note(index, value, rate) for all points, element by element.
  using Note = std::function<void(Eigen::Index index, double value, double rate)>;
  virtual void evaluate(double t, const Note& note) const = 0;
  virtual void evaluate_peak(double start, double end, const Note& note) const = 0;
  virtual Eigen::Index size() const = 0;  // number of points of all elements

 private:
  std::shared_ptr<const At> packed(const std::function<void(const Note&)>& evaluate) const;

  int points_;
  mutable std::mutex mutex_;
  mutable double time_ = 0;                 // of last_
  mutable std::shared_ptr<const At> last_;  // null before the first use
};

}  // namespace ORTHODYN_LANES

// Fixed values, one for each point, times a factor in time.
std::unique_ptr<PointValues> scaled_values(Vector values, std::shared_ptr<const TimeFunction> factor,
                                           int points_per_element);

// A formula of time and position. `places`: positions of the points at rest (m), one column each. `samples`: places at
// which step limits are found, the same on all ranks. `start` and `end` of the time span (s); differences in time do
// not cross `kinks` (s).
std::unique_ptr<PointValues> formula_values(TimePointFormula formula, Eigen::Matrix3Xd places, Eigen::Matrix3Xd samples,
                                            double start, double end, std::vector<double> kinks,
                                            int points_per_element);

}  // namespace orthodyn
