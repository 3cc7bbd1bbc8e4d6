// A scalar at the integration points of a region that may change in time: moisture, temperature, activation.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lib/config/formula.h"
#include "lib/core/types.h"
#include "lib/element/batch.h"
#include "lib/fem/differences.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

// Values and rates for batches of elements. Thread-safe: the values at one time are computed once, and their rates when
// they are needed, for powers only.
class PointValues {
 public:
  class At {
   public:
    // `find_rate`: computes the rates; empty if they are zero.
    At(std::vector<Batch> value, std::function<std::vector<Batch>()> find_rate)
        : value_(std::move(value)), find_rate_(std::move(find_rate)) {}

    std::size_t size() const { return value_.size(); }
    // By LawPoint::index; rates in 1/s.
    const Batch& value(std::size_t index) const { return value_[index]; }
    const Batch& rate(std::size_t index) const {
      std::call_once(once_, [&] { rate_ = find_rate_ ? find_rate_() : std::vector<Batch>(value_.size(), Batch(0)); });
      return rate_[index];
    }

   private:
    std::vector<Batch> value_;
    std::function<std::vector<Batch>()> find_rate_;
    mutable std::once_flag once_;
    mutable std::vector<Batch> rate_;
  };

  // `points`: number of integration points of an element.
  explicit PointValues(int points) : points_(points) {}
  virtual ~PointValues() = default;

  // This object must outlive the result.
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
  // Calls note(index, value) for all points, element by element.
  using Note = std::function<void(Eigen::Index index, double value)>;
  virtual void evaluate(double t, const Note& note) const = 0;
  virtual void evaluate_rates(double t, const Note& note) const = 0;
  virtual void evaluate_peak(double start, double end, const Note& note) const = 0;
  virtual Eigen::Index size() const = 0;  // number of points of all elements

 private:
  std::vector<Batch> packed(const std::function<void(const Note&)>& evaluate) const;

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
