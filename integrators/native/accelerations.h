// Predicts accelerations from the latest ones: by none (zero), or by the polynomial through one, two or three of them,
// whichever has been nearest lately.
//
// Through k accelerations it is off by O(h^k) where they are smooth. Where fast modes are passed over by the step,
// accelerations jump, and the more of them are extrapolated the worse.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "lib/core/types.h"
#include "lib/ode/vector_space.h"

namespace orthodyn {

class Accelerations {
 public:
  static constexpr int kMost = 3;

  // `space`: that of the accelerations.
  explicit Accelerations(const VectorSpace& space = {}) : space_(space) {}

  void clear() {
    count_ = 0;
    misses_.fill(0);
  }
  int count() const { return count_; }

  // The latest; its time must differ from those of the others.
  void add(double t, const ConstVectorRef& a) {
    judge(t, a);
    for (int k = kMost - 1; k > 0; --k) std::swap(entries_[at(k)], entries_[at(k - 1)]);
    entries_[0].t = t;
    entries_[0].a = a;
    count_ = std::min(count_ + 1, kMost);
  }

  // Latest first.
  double time(int k) const { return entries_[at(k)].t; }
  const Vector& value(int k) const { return entries_[at(k)].a; }

  std::size_t bytes() const {
    return (static_cast<std::size_t>(kMost) + 1) * static_cast<std::size_t>(guess_.size()) * sizeof(double);
  }

  // Precondition: count() > 0.
  void predict(double t, VectorRef a) const { extrapolate(t, best(), a); }

 private:
  struct Entry {
    double t = 0;
    Vector a;
  };
  static constexpr double kMemory = 0.5;  // weight of the past prediction error after each new one
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  // Lagrange's formula for the latest `used`; zero for none.
  void extrapolate(double t, int used, VectorRef a) const {
    a.setZero();
    for (int k = 0; k < used; ++k) a += weight(t, k, used) * entries_[at(k)].a;
  }

  double weight(double t, int k, int used) const {
    double w = 1;
    for (int j = 0; j < used; ++j)
      if (j != k) w *= (t - time(j)) / (time(k) - time(j));
    return w;
  }

  void judge(double t, const ConstVectorRef& a) {
    guess_.resize(a.size());
    for (int used = 0; used <= count_; ++used) {
      extrapolate(t, used, guess_);
      double& miss = misses_[at(used)];
      miss = kMemory * miss + space_.norm(guess_ - a);
    }
  }

  // The most that have been judged as often as the others, if equal.
  int best() const {
    int best = std::min(count_, 1);
    for (int used = 0; used <= count_; ++used)
      if (misses_[at(used)] > 0 && misses_[at(used)] < misses_[at(best)]) best = used;
    return best;
  }

  std::array<Entry, kMost> entries_;
  std::array<double, kMost + 1> misses_{};
  Vector guess_;
  int count_ = 0;
  VectorSpace space_;
};

}  // namespace orthodyn
