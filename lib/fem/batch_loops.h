// Loops over the elements of a region in batches of Batch::kLanes. Groups of batches run in parallel; results do not
// depend on the number of threads.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "lib/element/batch.h"
#include "lib/fem/element_groups.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

class BatchLoops {
 public:
  static constexpr int kLanes = Batch::kLanes;

  // `cells`: the region's cells of the mesh, in the order of by_place() (element_groups.h).
  BatchLoops(const ElementMesh& mesh, const std::vector<int>& cells)
      : size_(static_cast<int>(cells.size())), groups_(mesh, cells) {}

  // Calls visit(batch) for all batches; visit may add to values at the nodes of its batch.
  template <class Visit>
  void for_each_batch(Visit&& visit) const {
    groups_.for_each([&](const ElementGroups::Range& group) { in_group(group, visit); });
  }

  // Calls visit(k) for the elements of one batch, or for all elements.
  template <class Visit>
  void for_each_of(int batch, Visit&& visit) const {
    for (int k = batch * kLanes; k < std::min(size_, (batch + 1) * kLanes); ++k) visit(k);
  }
  template <class Visit>
  void for_each_element(Visit&& visit) const {
    for_each_batch([&](int b) { for_each_of(b, visit); });
  }

  // Sum of of_batch(batch) over all batches.
  template <class OfBatch>
  double sum(OfBatch&& of_batch) const {
    const auto of_group = [&](const ElementGroups::Range& group) {
      double total = 0;
      in_group(group, [&](int b) { total += of_batch(b); });
      return total;
    };
    double total = 0;
    for (const double share : groups_.of_each(of_group)) total += share;
    return total;
  }

  // The smallest value of of_batch(batch), and the number of its batch; infinity and -1 if there is no finite value.
  struct Smallest {
    double value;
    int batch;
  };
  template <class OfBatch>
  Smallest smallest(OfBatch&& of_batch) const {
    const Smallest none{std::numeric_limits<double>::infinity(), -1};
    const auto all = groups_.of_each([&](const ElementGroups::Range& group) {
      Smallest least = none;
      in_group(group, [&](int b) {
        if (const double value = of_batch(b); value < least.value) least = {value, b};
      });
      return least;
    });
    return std::accumulate(all.begin(), all.end(), none, [](const Smallest& least, const Smallest& other) {
      return other.value < least.value ? other : least;
    });
  }

 private:
  static_assert(ElementGroups::kElements % kLanes == 0);

  template <class Visit>
  static void in_group(const ElementGroups::Range& group, Visit&& visit) {
    for (int b = group.begin / kLanes; b * kLanes < group.end; ++b) visit(b);
  }

  int size_;
  ElementGroups groups_;
};

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
