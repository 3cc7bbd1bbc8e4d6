// The order of unknowns in the factor of `cholesky`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/linear/solver.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::ordering_test {
namespace {

struct Factored {
  std::string description;
  double error;  // relative
};

// A cube held at one face; `cells` per side.
Factored factored(const std::string& elements, int cells) {
  const BuiltTestScene s(fmt::format(
      "mesh: {{type: box, size: [1, 1, 1], cells: [{0}, {0}, {0}], elements: {1}}}\nmaterials: {{m: {{type: "
      "isotropic, density: 1, young: 1, nu: 0.3}}}}\nclamps: [{{surface: x0}}]\ntime: {{end: 1}}\n",
      cells, elements));
  const auto solver = make_linear_solver({"cholesky", ""}, s.model().pattern());
  Linearization at;
  s.model().linearize(0, s.zero(), s.zero(), TangentKind::exact, at);
  std::vector<double> K(s.model().pattern().row.size());
  s.model().combine({0, 0, 1}, at, K.data());
  EXPECT_EQ(solver->factor(K.data()), FactorStatus::ok);
  Random random(31);
  const Vector x = random_dofs(random, s.size(), 1);
  Vector b(x.size()), found(x.size());
  s.model().multiply_matrix(K.data(), x, b);
  solver->solve(b, found);
  return {solver->description(), (found - x).norm() / x.norm()};
}

// Quadratic hexahedra fill more by minimum degree: nested dissection saves two thirds of the operations.
TEST(Ordering, IsByNestedDissectionWhereItSavesOperations) {
  const Factored hexahedra = factored("hexahedra", 8);
  EXPECT_NE(hexahedra.description.find("nested dissection"), std::string::npos) << hexahedra.description;
  EXPECT_LT(hexahedra.error, 1e-10);
  const Factored few = factored("hexahedra", 3);
  EXPECT_NE(few.description.find("minimum degree"), std::string::npos) << few.description;
  EXPECT_LT(few.error, 1e-10);
}

}  // namespace
}  // namespace orthodyn::ordering_test
