// Finds the largest value of a function of time that is known on one step after the other.
//
// A step is sampled at both ends and at three times between them. Around a sample that is larger than its neighbours,
// the time of the maximum is found by Brent's method (Brent 1973, chapter 5), to about 1e-8 of the step. A maximum that
// lies between two samples of which neither exceeds its neighbours is missed. The start and the end of the run count as
// maxima if the function falls from or rises to them.
#pragma once

#include <functional>
#include <limits>

#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

class TimeExtreme {
 public:
  using Function = std::function<double(double t)>;

  struct Maximum {
    double t = 0, value = std::numeric_limits<double>::quiet_NaN();  // NaN: none
    bool jumps = false;                                              // whether the function jumps at t
    bool exists() const { return value == value; }
  };

  void start(double t, double value);
  // A step, which begins where the last one ended. `f` is called within [begin, end].
  void advance(double begin, double end, const Function& f);

  // The largest maximum. If the function still rises, its last value counts as long as the run does not go on; then
  // ends_run() is true.
  Maximum largest() const { return ends_run() ? last_ : largest_; }
  bool ends_run() const { return last_.exists() && !(largest_.value >= last_.value); }
  // The largest of all other maxima.
  Maximum next() const { return ends_run() ? largest_ : next_; }
  // Largest value less the smallest one.
  double range() const { return high_ - low_; }
  long samples() const { return samples_; }

  void save(const std::string& name, Archive& archive) const;
  void restore(const std::string& name, const Archive& archive);

 private:
  double sample(double value);
  void complete(const Maximum& maximum);
  // The maximum of f in [a, b]; at an end if f is monotone.
  Maximum search(double a, double b, const Function& f);
  bool is_relevant(double value, double rise) const;
  void pass_joint(double t, double value, bool falls);

  Maximum largest_, next_;  // complete: the function has fallen since
  Maximum last_;            // at the end of the last step, if the function rose to it
  double end_value_ = 0;    // of the last step
  double high_ = -std::numeric_limits<double>::infinity(), low_ = std::numeric_limits<double>::infinity();
  long samples_ = 0;
};

}  // namespace orthodyn
