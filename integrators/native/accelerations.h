// Predicts accelerations: the polynomial through the latest ones, extrapolated.
//
// Through k accelerations it is off by O(h^k), and a displacement built from it by O(h^(k+2)).
#pragma once

#include <array>
#include <utility>

#include "lib/core/types.h"

namespace orthodyn {

class Accelerations {
 public:
  static constexpr int kMost = 3;

  void clear() { count_ = 0; }
  int count() const { return count_; }

  // The latest; its time must differ from those of the others.
  void add(double t, const ConstVectorRef& a) {
    for (int k = kMost - 1; k > 0; --k) std::swap(entries_[at(k)], entries_[at(k - 1)]);
    entries_[0].t = t;
    entries_[0].a = a;
    count_ = std::min(count_ + 1, kMost);
  }

  // Latest first.
  double time(int k) const { return entries_[at(k)].t; }
  const Vector& value(int k) const { return entries_[at(k)].a; }

  // By Lagrange's formula. Precondition: count() > 0.
  void predict(double t, VectorRef a) const {
    a = weight(t, 0) * entries_[0].a;
    for (int k = 1; k < count_; ++k) a += weight(t, k) * entries_[at(k)].a;
  }

 private:
  struct Entry {
    double t = 0;
    Vector a;
  };
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  double weight(double t, int k) const {
    double w = 1;
    for (int j = 0; j < count_; ++j)
      if (j != k) w *= (t - time(j)) / (time(k) - time(j));
    return w;
  }

  std::array<Entry, kMost> entries_;
  int count_ = 0;
};

}  // namespace orthodyn
