// The strain of a free body by swelling and thermal expansion: e* = sum of theta diag(a1, a2, a3) along the material
// axes, for the changes theta of moisture and temperature.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/added_laws/point_values.h"

namespace orthodyn {

struct Swelling {
  std::string cause;                          // "moisture" or "temperature"
  Vec3 coefficients;                          // strain along the material axes per unit of change
  std::shared_ptr<const PointValues> change;  // per cent or K
};

inline namespace ORTHODYN_LANES {

// e* at one time, or its peak. No causes: zero.
class StressFreeStrain {
 public:
  StressFreeStrain() = default;
  // changes_of(values): PointValues::At of the values of a cause.
  template <class ChangesOf>
  StressFreeStrain(const std::vector<Swelling>& causes, ChangesOf&& changes_of, double factor = 1) {
    for (const Swelling& cause : causes)
      parts_.push_back({Vec3(factor * cause.coefficients), changes_of(*cause.change)});
  }
  static StressFreeStrain at(const std::vector<Swelling>& causes, double t, double factor = 1) {
    return {causes, [t](const PointValues& values) { return values.at(t); }, factor};
  }

  // The largest size from `start` to `end` (s). Peaks of several causes add up, as they may be at different times.
  static StressFreeStrain peak(const std::vector<Swelling>& causes, double start, double end) {
    StressFreeStrain sum(causes, [start, end](const PointValues& values) { return values.at_peak(start, end); });
    sum.is_peak_ = true;
    return sum;
  }

  bool is_zero() const { return parts_.empty(); }

  // Normal strains along the material axes, and their rates (1/s), at a point (LawPoint::index).
  Vec3T<Batch> strain(std::size_t index) const {
    return sum([&](const PointValues::At& change) { return change.value(index); });
  }
  Vec3T<Batch> rate(std::size_t index) const {
    return sum([&](const PointValues::At& change) { return change.rate(index); });
  }

 private:
  struct Part {
    Vec3 coefficients;
    std::shared_ptr<const PointValues::At> change;
  };

  template <class ValueOf>
  Vec3T<Batch> sum(ValueOf&& value_of) const {
    Vec3T<Batch> e = Vec3T<Batch>::Zero();
    for (const Part& part : parts_) {
      const Vec3T<Batch> own = value_of(*part.change) * part.coefficients.cast<Batch>();
      if (is_peak_) add_peak(own, e);
      else e += own;
    }
    return e;
  }

  static void add_peak(const Vec3T<Batch>& own, Vec3T<Batch>& e) {
    for (int i = 0; i < 3; ++i) {
      double lanes[Batch::kLanes];
      for (int l = 0; l < Batch::kLanes; ++l)
        lanes[l] = e[i][l] + std::copysign(own[i][l], e[i][l] != 0 ? e[i][l] : own[i][l]);
      e[i] = Batch::load(lanes);
    }
  }

  std::vector<Part> parts_;
  bool is_peak_ = false;
};

}  // namespace ORTHODYN_LANES

inline bool are_constant(const std::vector<Swelling>& causes) {
  return std::all_of(causes.begin(), causes.end(), [](const Swelling& cause) { return cause.change->constant(); });
}

}  // namespace orthodyn
