// Products and norms of a model's vectors. Where several ranks hold parts of a vector they are those of the whole, the
// same on all ranks; otherwise they cost what they cost without this.
#pragma once

#include <cmath>

#include "lib/core/ranks.h"
#include "lib/core/types.h"

namespace orthodyn {

class VectorSpace {
 public:
  // Of vectors that are whole.
  VectorSpace() = default;
  // Of vectors with `size` entries in all. `ranks`, null for whole ones, must outlive it.
  VectorSpace(const Ranks* ranks, Eigen::Index size) : ranks_(ranks), size_(size) {}

  // Entries of the whole of which x is this rank's part.
  Eigen::Index size(const ConstVectorRef& x) const { return ranks_ ? size_ : x.size(); }

  double sum(double of_part) const { return ranks_ ? ranks_->sum(of_part) : of_part; }
  double largest(double of_part) const { return ranks_ ? ranks_->max(of_part) : of_part; }
  bool any(bool in_part) const { return ranks_ ? ranks_->any(in_part) : in_part; }
  bool all(bool in_part) const { return !any(!in_part); }

  double dot(const ConstVectorRef& x, const ConstVectorRef& y) const { return sum(x.dot(y)); }
  double norm(const ConstVectorRef& x) const { return ranks_ ? std::sqrt(sum(x.squaredNorm())) : x.norm(); }
  // Without overflow of the squares of one part.
  double stable_norm(const ConstVectorRef& x) const {
    const double part = x.stableNorm();
    return ranks_ ? std::sqrt(sum(part * part)) : part;
  }
  // Of the entries' sizes; 0 without entries.
  double largest_entry(const ConstVectorRef& x) const {
    return largest(x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0);
  }
  double sum_of_sizes(const ConstVectorRef& x) const { return sum(x.lpNorm<1>()); }
  bool is_zero(const ConstVectorRef& x) const { return all(x.isZero(0)); }
  bool is_finite(const ConstVectorRef& x) const { return all(x.allFinite()); }

 private:
  const Ranks* ranks_ = nullptr;
  Eigen::Index size_ = 0;
};

}  // namespace orthodyn
