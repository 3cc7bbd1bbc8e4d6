// Products and norms of a model's vectors. For vectors distributed over ranks they are those of the whole vector,
// identical on all ranks; for a model of one process there is no overhead.
#pragma once

#include <cmath>

#include "lib/core/ranks.h"
#include "lib/core/types.h"

namespace orthodyn {

class VectorSpace {
 public:
  // Vectors of one process.
  VectorSpace() = default;
  // Vectors with `size` entries on all ranks together. `ranks` is null for one process and must outlive this object.
  VectorSpace(const Ranks* ranks, Eigen::Index size) : ranks_(ranks), size_(size) {}

  // Number of entries, on all ranks, of the vector whose part on this rank is x.
  Eigen::Index size(const ConstVectorRef& x) const { return ranks_ ? size_ : x.size(); }

  double sum(double of_part) const { return ranks_ ? ranks_->sum(of_part) : of_part; }
  double largest(double of_part) const { return ranks_ ? ranks_->max(of_part) : of_part; }
  bool any(bool in_part) const { return ranks_ ? ranks_->any(in_part) : in_part; }
  bool all(bool in_part) const { return !any(!in_part); }

  double dot(const ConstVectorRef& x, const ConstVectorRef& y) const { return sum(x.dot(y)); }
  double norm(const ConstVectorRef& x) const { return ranks_ ? std::sqrt(sum(x.squaredNorm())) : x.norm(); }
  // Norm in which the squares of one rank's part do not overflow.
  double stable_norm(const ConstVectorRef& x) const {
    const double part = x.stableNorm();
    return ranks_ ? std::sqrt(sum(part * part)) : part;
  }
  // Largest magnitude of an entry; 0 for an empty vector.
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
