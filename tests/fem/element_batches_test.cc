// The last batch of a region is padded with copies. They may write only to nodes of its own elements, because groups of
// elements run in parallel (element_groups.h).
#include "lib/fem/element_batches.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "lib/element/tet10.h"
#include "lib/element/tet4.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::element_batches_test {
namespace {

template <Element E>
void expect_copies_of_the_last_element(int order) {
  const BuiltTestScene scene(
      fmt::format("mesh: {{type: box, size: [30, 1, 1], cells: [31, 1, 1], order: {}}}\n"
                  "materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0.3}}}}\n"
                  "clamps: [{{surface: x0}}]\ntime: {{end: 1}}\n",
                  order));
  const ElementMesh mesh(scene.mesh());
  std::vector<int> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  ASSERT_NE(cells.size() % Batch::kLanes, 0u);
  const ElementBatches<E> elements(mesh, cells, ElementAxes(Mat3::Identity()), nullptr);
  const int last = elements.num_batches() - 1;
  // A NaN stress marks every node that it is added to, even with a volume of zero.
  Mat3T<Batch> P;
  P.fill(Batch(std::numeric_limits<double>::quiet_NaN()));
  NodalVector f = NodalVector::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  typename ElementBatches<E>::Columns force;
  elements.add_forces(last, 0, P, true, force);
  elements.scatter(last, force, f);
  std::set<int> own;
  for (int l = 0; l < elements.lanes(last); ++l)
    for (const int node : elements.nodes(last * Batch::kLanes + l)) own.insert(node);
  for (int node = 0; node < f.cols(); ++node) EXPECT_EQ(std::isnan(f(0, node)), own.contains(node)) << node;
}

TEST(ElementBatches, AreFilledUpWithTheLastElement) {
  expect_copies_of_the_last_element<Tet4>(1);
  expect_copies_of_the_last_element<Tet10>(2);
}

}  // namespace
}  // namespace orthodyn::element_batches_test
