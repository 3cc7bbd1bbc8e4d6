// Interpolation at points within elements.
#include "lib/mesh/mesh_point.h"

#include <gtest/gtest.h>

#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn::mesh_point_test {
namespace {

Mesh box_of_order(int order) {
  Mesh mesh = make_box({.size = {2, 1, 1}, .cells = {3, 2, 1}});
  if (order == 2) make_quadratic(mesh);
  return mesh;
}

// Interpolates nodal values of a field at a mesh point.
template <class Field>
double at(const Mesh& mesh, const Vec3& place, const Field& field) {
  double sum = 0;
  for (const auto& [node, weight] : mesh_point(mesh, place).nodes)
    sum += weight * field(mesh.nodes[static_cast<std::size_t>(node)]);
  return sum;
}

TEST(MeshPoint, ReproducesFieldsOfTheElementsOrder) {
  const auto linear = [](const Vec3& x) { return 1 + x[0] - 2 * x[1] + 3 * x[2]; };
  const auto quadratic = [](const Vec3& x) { return x[0] * x[1] - x[2] * x[2] + x[0]; };
  for (const Vec3& place : {Vec3(0.3, 0.4, 0.7), Vec3(2, 0.5, 0.5), Vec3(0, 0, 0), Vec3(1.9, 0.01, 0.99)}) {
    EXPECT_NEAR(at(box_of_order(1), place, linear), linear(place), 1e-12);
    EXPECT_NEAR(at(box_of_order(2), place, quadratic), quadratic(place), 1e-12);
  }
}

TEST(MeshPoint, APlaceOutsideOfTheBodyIsOneAtItsSurface) {
  const auto x = [](const Vec3& p) { return p[0]; };
  EXPECT_NEAR(at(box_of_order(2), {2.001, 0.5, 0.5}, x), 2, 1e-3);
}

}  // namespace
}  // namespace orthodyn::mesh_point_test
