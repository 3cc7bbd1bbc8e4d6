// Multipliers of constraints at the ends of the last steps, and the polynomial in time through them.
#pragma once

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn::sundials {

class MultiplierHistory {
 public:
  void clear() { ends_.clear(); }
  // Times (s) ascend.
  void add(double t, Vector multipliers) {
    ends_.emplace_front(t, std::move(multipliers));
    if (ends_.size() > kMost) ends_.pop_back();
  }
  // The polynomial of the degree `degree`, or of the largest one that the ends give, through the last ends. Empty if
  // there are none.
  Vector at(double t, int degree) const {
    const std::size_t count = std::min(ends_.size(), static_cast<std::size_t>(degree) + 1);
    if (count == 0) return {};
    std::vector<Vector> values;  // Neville's scheme
    for (std::size_t i = 0; i < count; ++i) values.push_back(ends_[i].second);
    for (std::size_t k = 1; k < count; ++k)
      for (std::size_t i = 0; i + k < count; ++i) {
        const double share = (t - ends_[i].first) / (ends_[i + k].first - ends_[i].first);
        values[i] += share * (values[i + 1] - values[i]);
      }
    return values[0];
  }

 private:
  static constexpr std::size_t kMost = 6;       // for methods of order 5
  std::deque<std::pair<double, Vector>> ends_;  // the last one first
};

}  // namespace orthodyn::sundials
