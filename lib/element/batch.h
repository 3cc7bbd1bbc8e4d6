// A SIMD number: several doubles, for kernels that process one element per lane.
//
// Provides arithmetic, sqrt, comparisons that give a mask, and select() by a mask. The same functions exist for double
// with bool as the mask, so that one kernel template serves both.
#pragma once

#include <cmath>
#include <cstdint>

#include "lib/core/types.h"

namespace orthodyn {

// The number of lanes is part of the namespace: a plugin that is compiled for another number of lanes than the library
// fails to load, since the library lacks the polar decomposition (polar.h) for it. The names of ElementAxes and
// ElementBatches, whose layout depends on the lanes, contain the number too.
#if defined(__AVX512F__)
inline constexpr int kBatchLanes = 8;
#define ORTHODYN_LANES lanes_8
#else
inline constexpr int kBatchLanes = 4;
#define ORTHODYN_LANES lanes_4
#endif

// Inlines everything that a batch kernel calls. Off with the address sanitizer, where inlining takes minutes to
// compile.
#if defined(__SANITIZE_ADDRESS__)
#define ORTHODYN_FLATTEN
#else
#define ORTHODYN_FLATTEN [[gnu::flatten]]
#endif

inline namespace ORTHODYN_LANES {

class Batch {
 public:
  static constexpr int kLanes = kBatchLanes;
  using Pack = double __attribute__((vector_size(kLanes * sizeof(double))));
  using Mask = std::int64_t __attribute__((vector_size(kLanes * sizeof(double))));

  Batch() = default;
  Batch(double x) : v_(x - Pack{}) {}  // NOLINT: numbers convert
  explicit Batch(Pack v) : v_(v) {}
  static Batch load(const double* lanes) {
    Batch b;
    __builtin_memcpy(&b.v_, lanes, sizeof b.v_);
    return b;
  }
  void store(double* lanes) const { __builtin_memcpy(lanes, &v_, sizeof v_); }
  double operator[](int lane) const { return v_[lane]; }
  Pack pack() const { return v_; }

  friend Batch operator+(const Batch& a, const Batch& b) { return Batch(a.v_ + b.v_); }
  friend Batch operator-(const Batch& a, const Batch& b) { return Batch(a.v_ - b.v_); }
  friend Batch operator*(const Batch& a, const Batch& b) { return Batch(a.v_ * b.v_); }
  friend Batch operator/(const Batch& a, const Batch& b) { return Batch(a.v_ / b.v_); }
  friend Batch operator-(const Batch& a) { return Batch(-a.v_); }
  Batch& operator+=(const Batch& b) { return *this = *this + b; }
  Batch& operator-=(const Batch& b) { return *this = *this - b; }
  Batch& operator*=(const Batch& b) { return *this = *this * b; }
  Batch& operator/=(const Batch& b) { return *this = *this / b; }
  friend Mask operator>(const Batch& a, const Batch& b) { return a.v_ > b.v_; }
  friend Mask operator<(const Batch& a, const Batch& b) { return a.v_ < b.v_; }
  friend Mask operator>=(const Batch& a, const Batch& b) { return a.v_ >= b.v_; }
  friend Mask operator<=(const Batch& a, const Batch& b) { return a.v_ <= b.v_; }

 private:
  Pack v_;
};

}  // namespace ORTHODYN_LANES

// The instruction set that the library was compiled for: "AVX-512", "AVX2", ...
const char* vector_instructions();

inline Batch sqrt(const Batch& x) {
  Batch::Pack root;
  for (int i = 0; i < Batch::kLanes; ++i) root[i] = std::sqrt(x[i]);
  return Batch(root);
}
inline Batch select(const Batch::Mask& m, const Batch& a, const Batch& b) { return Batch(m ? a.pack() : b.pack()); }
inline bool all(const Batch::Mask& m) {
  std::int64_t every = -1;
  for (int i = 0; i < Batch::kLanes; ++i) every &= m[i];
  return every != 0;
}

inline Batch real(const Batch& x) { return x; }

template <class T>
T select(bool m, const T& a, const T& b) {
  return m ? a : b;
}
inline bool all(bool m) { return m; }

}  // namespace orthodyn

namespace Eigen {

template <>
struct NumTraits<orthodyn::Batch> : NumTraits<double> {
  using Real = orthodyn::Batch;
  using NonInteger = orthodyn::Batch;
  using Nested = orthodyn::Batch;
  using Literal = orthodyn::Batch;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

template <class Op>
struct ScalarBinaryOpTraits<double, orthodyn::Batch, Op> {
  using ReturnType = orthodyn::Batch;
};
template <class Op>
struct ScalarBinaryOpTraits<orthodyn::Batch, double, Op> {
  using ReturnType = orthodyn::Batch;
};

}  // namespace Eigen
