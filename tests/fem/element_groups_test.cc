#include "lib/fem/element_groups.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "lib/fem/batch_loops.h"
#include "lib/mesh/box.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::element_groups_test {
namespace {

class Groups : public testing::TestWithParam<int> {
 protected:
  Groups()
      : scene_(fmt::format("mesh: {{type: box, size: [3, 1, 1], cells: [24, 8, 8], order: {}}}\n"
                           "materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0.3}}}}\n"
                           "clamps: [{{surface: x0}}]\ntime: {{end: 1}}\n",
                           GetParam())),
        mesh_(scene_.mesh()),
        cells_(scene_.mesh().cells.size()) {
    std::iota(cells_.begin(), cells_.end(), 0);
    std::shuffle(cells_.begin(), cells_.end(), std::mt19937(1));
  }

  std::set<int> nodes_of(const ElementGroups& groups, const std::vector<int>& cells, int group) const {
    std::set<int> nodes;
    for (int k = groups.elements(group).begin; k < groups.elements(group).end; ++k)
      for (const int node : mesh_.cells[static_cast<std::size_t>(cells[static_cast<std::size_t>(k)])])
        nodes.insert(node);
    return nodes;
  }

  BuiltTestScene scene_;
  ElementMesh mesh_;
  std::vector<int> cells_;
};

TEST_P(Groups, HoldEachElementOnce) {
  auto sorted = by_place(mesh_, cells_);
  const ElementGroups groups(mesh_, sorted);
  EXPECT_EQ(groups.size(), 30);  // 7,680 of 256
  int begin = 0;
  for (int group = 0; group < groups.size(); ++group) {
    EXPECT_EQ(groups.elements(group).begin, begin);
    begin = groups.elements(group).end;
  }
  EXPECT_EQ(begin, 7680);
  std::sort(sorted.begin(), sorted.end());
  std::sort(cells_.begin(), cells_.end());
  EXPECT_EQ(sorted, cells_);
}

TEST_P(Groups, OfOneColourShareNoNode) {
  for (const bool in_place : {true, false}) {
    const auto cells = in_place ? by_place(mesh_, cells_) : cells_;
    const ElementGroups groups(mesh_, cells);
    int count = 0;
    for (const auto& colour : groups.colours()) {
      std::set<int> seen;
      for (const int group : colour) {
        ++count;
        for (const int node : nodes_of(groups, cells, group)) EXPECT_TRUE(seen.insert(node).second) << node;
      }
    }
    EXPECT_EQ(count, groups.size());
    if (in_place) {
      EXPECT_LE(groups.colours().size(), 12u);
    }
  }
}

TEST_P(Groups, OfFewElementsAreOne) {
  cells_.resize(700);
  const ElementGroups groups(mesh_, by_place(mesh_, cells_));
  EXPECT_EQ(groups.size(), 1);
  EXPECT_EQ(groups.elements(0).end, 700);
  EXPECT_EQ(groups.colours(), (std::vector<std::vector<int>>{{0}}));
}

INSTANTIATE_TEST_SUITE_P(Orders, Groups, testing::Values(1, 2));

TEST(BatchLoops, TheSmallestIsOfTheBatchThatGaveIt) {
  const Mesh mesh = make_box({.cells = {6, 5, 4}});
  std::vector<int> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  const ElementMesh elements(mesh);
  const BatchLoops loops(elements, cells);
  const int batches = (static_cast<int>(cells.size()) + BatchLoops::kLanes - 1) / BatchLoops::kLanes;
  for (const int wanted : {0, 7, batches - 1}) {
    std::vector<int> calls(static_cast<std::size_t>(batches), 0);
    const auto found = loops.smallest([&](int b) {
      const int before = calls[static_cast<std::size_t>(b)]++;
      return (b == wanted ? 1.0 : 2.0) + 1e-16 * b + before;
    });
    EXPECT_EQ(found.batch, wanted);
    EXPECT_EQ(*std::max_element(calls.begin(), calls.end()), 1);
  }
  EXPECT_EQ(loops.smallest([](int) { return std::numeric_limits<double>::infinity(); }).batch, -1);
  EXPECT_EQ(loops.smallest([](int b) { return b == 3 ? 1 : std::numeric_limits<double>::quiet_NaN(); }).batch, 3);
  EXPECT_EQ(BatchLoops(elements, {}).smallest([](int) { return 0.0; }).batch, -1);
}

}  // namespace
}  // namespace orthodyn::element_groups_test
