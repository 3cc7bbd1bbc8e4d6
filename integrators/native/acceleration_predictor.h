// Predicts an acceleration as zero or by the polynomial through the last one, two or three values, whichever prediction
// has been most accurate lately.
//
// Extrapolation through k smooth accelerations has an error of O(h^k). If steps are longer than the periods of fast
// modes, accelerations jump and the error grows with k.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "lib/core/types.h"
#include "lib/ode/vector_space.h"

namespace orthodyn {

class AccelerationPredictor {
 public:
  static constexpr int kMaxCount = 3;

  // `space`: Model::space().
  explicit AccelerationPredictor(const VectorSpace& space = {}) : space_(space) {}

  void clear() {
    count_ = 0;
    errors_.fill(0);
  }

  // Adds the latest acceleration. Precondition: t differs from the times of the stored accelerations.
  void add(double t, const ConstVectorRef& a) {
    update_errors(t, a);
    for (int k = kMaxCount - 1; k > 0; --k) std::swap(entries_[at(k)], entries_[at(k - 1)]);
    entries_[0].t = t;
    entries_[0].a = a;
    count_ = std::min(count_ + 1, kMaxCount);
  }

  std::size_t bytes() const {
    return (static_cast<std::size_t>(kMaxCount) + 1) * static_cast<std::size_t>(guess_.size()) * sizeof(double);
  }

  // Predicts the acceleration at time t. Precondition: an acceleration has been added.
  void predict(double t, VectorRef a) const { extrapolate(t, best(), a); }

 private:
  struct Entry {
    double t = 0;
    Vector a;
  };
  static constexpr double kMemory = 0.5;  // factor on the past prediction errors when a new one is added
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  // Extrapolates the last `used` values by Lagrange's formula; gives zero if used = 0.
  void extrapolate(double t, int used, VectorRef a) const {
    a.setZero();
    for (int k = 0; k < used; ++k) a += weight(t, k, used) * entries_[at(k)].a;
  }

  double weight(double t, int k, int used) const {
    double w = 1;
    for (int j = 0; j < used; ++j)
      if (j != k) w *= (t - entries_[at(j)].t) / (entries_[at(k)].t - entries_[at(j)].t);
    return w;
  }

  void update_errors(double t, const ConstVectorRef& a) {
    guess_.resize(a.size());
    for (int used = 0; used <= count_; ++used) {
      extrapolate(t, used, guess_);
      double& error = errors_[at(used)];
      error = kMemory * error + space_.norm(guess_ - a);
    }
  }

  // Number of values whose extrapolation has the smallest error.
  int best() const {
    int best = std::min(count_, 1);
    for (int used = 0; used <= count_; ++used)
      if (errors_[at(used)] > 0 && errors_[at(used)] < errors_[at(best)]) best = used;
    return best;
  }

  std::array<Entry, kMaxCount> entries_;
  std::array<double, kMaxCount + 1> errors_{};
  Vector guess_;
  int count_ = 0;
  VectorSpace space_;
};

}  // namespace orthodyn
