#include "lib/fem/element_groups.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace orthodyn {

namespace {

constexpr int kFewestGroups = 4;  // with fewer groups threads gain nothing
constexpr int kMostColours = 64;

using Colours = std::uint64_t;  // a set of colours, one bit each

std::vector<Vec3> centres_of(const ElementMesh& mesh) {
  std::vector<Vec3> centres(mesh.cells.size());
  for (std::size_t k = 0; k < centres.size(); ++k) centres[k] = mesh.positions(k).rowwise().mean();
  return centres;
}

class Bisection {
 public:
  explicit Bisection(const ElementMesh& mesh) : centres_(centres_of(mesh)) {}

  void sort(int* begin, int* end) const {
    if (end - begin <= ElementGroups::kElements) return std::sort(begin, end);
    const int axis = longest_side(begin, end);
    const auto groups = (end - begin + ElementGroups::kElements - 1) / ElementGroups::kElements;
    int* const middle = begin + groups / 2 * ElementGroups::kElements;
    std::nth_element(begin, middle, end, [&](int a, int b) {
      const double x = centre(a)[axis], y = centre(b)[axis];
      return x != y ? x < y : a < b;
    });
    sort(begin, middle);
    sort(middle, end);
  }

 private:
  const Vec3& centre(int cell) const { return centres_[static_cast<std::size_t>(cell)]; }

  int longest_side(const int* begin, const int* end) const {
    Vec3 low = centre(*begin), high = low;
    for (const int* cell = begin; cell != end; ++cell) {
      low = low.cwiseMin(centre(*cell));
      high = high.cwiseMax(centre(*cell));
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    return axis;
  }

  std::vector<Vec3> centres_;
};

}  // namespace

std::vector<int> by_place(const ElementMesh& mesh, std::vector<int> cells) {
  Bisection(mesh).sort(cells.data(), cells.data() + cells.size());
  return cells;
}

ElementGroups::ElementGroups(const ElementMesh& mesh, const std::vector<int>& cells)
    : num_elements_(static_cast<int>(cells.size())), size_((num_elements_ + kElements - 1) / kElements) {
  if (size_ < kFewestGroups) size_ = 1;
  std::vector<Colours> taken(mesh.nodes.size(), 0);  // colours of the groups at each node
  const auto for_each_node = [&](int group, auto&& visit) {
    for (int k = elements(group).begin; k < elements(group).end; ++k)
      for (const int node : mesh.cells[static_cast<std::size_t>(cells[static_cast<std::size_t>(k)])]) {
        visit(taken[static_cast<std::size_t>(node)]);
        if (mesh.ties && mesh.ties->is_tied(node))
          mesh.ties->for_each_leader(node, [&](int leader, double) { visit(taken[static_cast<std::size_t>(leader)]); });
      }
  };
  for (int group = 0; group < size_; ++group) {
    Colours near = 0;
    for_each_node(group, [&](const Colours& at) { near |= at; });
    const int colour = std::countr_one(near);
    if (colour == kMostColours) {  // too many groups share a node, so that no parallel loop is possible
      size_ = 1;
      break;
    }
    colours_.resize(std::max(colours_.size(), static_cast<std::size_t>(colour) + 1));
    colours_[static_cast<std::size_t>(colour)].push_back(group);
    for_each_node(group, [&](Colours& at) { at |= Colours{1} << colour; });
  }
  if (size_ == 1) colours_ = {{0}};
}

ElementGroups::Range ElementGroups::elements(int group) const {
  if (size_ == 1) return {0, num_elements_};
  return {group * kElements, std::min((group + 1) * kElements, num_elements_)};
}

}  // namespace orthodyn
