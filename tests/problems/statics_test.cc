// Linear statics by one solve with K, against closed forms and independent programs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "tests/fem/built_scene.h"

namespace orthodyn::statics_test {
namespace {

// A block in tension along x with fibres at -theta from x, supported statically determinately: the stress is uniform,
// and linear elements are exact.
struct OffAxis {
  double modulus, coupling;  // Pa, gamma_xy / eps_x
};

OffAxis measured(double degrees) {
  const double theta = degrees * std::numbers::pi / 180, c = std::cos(theta), s = std::sin(theta), pull = 1e6;
  const BuiltTestScene block(fmt::format(R"(
mesh: {{type: box, size: [1, 0.5, 0.4], cells: [3, 2, 2], order: 1}}
materials:
  spruce: {{type: orthotropic, density: 400, young: [10.8e9, 0.84e9, 0.46e9], nu12: 0.44, nu23: 0.44, nu31: 0.0225,
           g12: 0.69e9, g23: 0.032e9, g13: 0.66e9}}
regions: {{body: {{material: spruce, axes: {{first: [{0}, -{1}, 0], second: [{1}, {0}, 0]}}}}}}
clamps:
  - {{nearest: [0, 0, 0]}}
  - {{nearest: [1, 0, 0], components: [y, z]}}
  - {{nearest: [0, 0.5, 0], components: [z]}}
loads: [{{surface: x0, traction: [-{2}, 0, 0]}}, {{surface: x1, traction: [{2}, 0, 0]}}]
time: {{end: 1}}
)",
                                         c, s, pull));
  const NodalVector u = block.nodal(linear_static(block));
  const double eps_x = u(0, nearest_node(block.mesh(), {1, 0, 0}));
  const double gamma_xy = u(0, nearest_node(block.mesh(), {0, 0.5, 0})) / 0.5;
  return {pull / eps_x, gamma_xy / eps_x};
}

TEST(OffAxisTension, HasTheClosedFormModulusAndShearCoupling) {
  const double E1 = 10.8e9, E2 = 0.84e9, G = 0.69e9, nu = 0.44;
  for (const double degrees : {15.0, 30.0, 45.0, 75.0}) {
    const double theta = degrees * std::numbers::pi / 180, c = std::cos(theta), s = std::sin(theta);
    const double mixed = 1 / G - 2 * nu / E1;
    const double Ex = 1 / (std::pow(c, 4) / E1 + std::pow(s, 4) / E2 + mixed * s * s * c * c);
    const double eta = Ex * (2 * s * c * (-c * c / E1 + s * s / E2) + mixed * s * c * (c * c - s * s));
    const auto found = measured(degrees);
    EXPECT_NEAR(found.modulus, Ex, 1e-10 * Ex) << degrees;
    EXPECT_NEAR(found.coupling, eta, 1e-10) << degrees;
  }
}

TEST(OffAxisTension, OfSpruceMatchesTheTable) {
  struct Row {
    double degrees, modulus, coupling;
  };
  for (const auto& row :
       {Row{15, 5.833211e9, 1.708048}, Row{30, 2.611311e9, 1.289311}, Row{45, 1.508943e9, 0.828322}}) {
    const auto found = measured(row.degrees);
    EXPECT_NEAR(found.modulus, row.modulus, 1e3);
    EXPECT_NEAR(found.coupling, row.coupling, 1e-6);
  }
}

class Reference : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("ORTHODYN_DATA");
    if (!data) GTEST_SKIP() << "ORTHODYN_DATA is not set: no reference data";
    folder_ = std::string(data) + "/reference/";
  }

  // Rows "node,ux,uy,uz", nodes from 1 in order.
  NodalVector displacements(const std::string& file, Eigen::Index nodes) const {
    std::ifstream in(folder_ + file);
    std::string line;
    std::getline(in, line);
    NodalVector u(3, nodes);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      std::getline(in, line);
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream row(line);
      Eigen::Index node = 0;
      row >> node >> u(0, i) >> u(1, i) >> u(2, i);
      EXPECT_EQ(node, i + 1);
    }
    return u;
  }

  // From case.json of C01a: off-axis orthotropic cantilever under a tip traction.
  BuiltTestScene cantilever(const std::string& mesh) const {
    return BuiltTestScene(fmt::format(R"(
mesh: {{type: gmsh, file: {}}}
materials:
  solid: {{type: orthotropic, density: 420, young: [11e9, 0.9e9, 0.5e9], nu12: 0.37, nu13: 0.42, nu23: 0.47,
          g12: 0.75e9, g13: 0.72e9, g23: 0.039e9}}
regions:
  solid:
    material: solid
    axes:
      first: [0.9274777915203365, 0.32461722703211776, 0.1854955583040673]
      second: [-0.37051096500769853, 0.8644610922477269, 0.3397479136049706]
clamps: [{{surface: fixed}}]
loads: [{{surface: load, traction: [2000, -5000, 12000]}}]
time: {{end: 1}}
)",
                                      folder_ + "meshes/" + mesh));
  }

  std::string folder_;
};

TEST_F(Reference, OffAxisCantileverBendsAsInGetFem) {
  for (const char* mesh : {"beam.v22.msh", "beam.v41.msh"}) {
    const auto scene = cantilever(mesh);
    const NodalVector u = scene.nodal(linear_static(scene));
    const NodalVector expected = displacements("C01a_ortho_traction/getfem.csv", u.cols());
    EXPECT_LE((u - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff()) << mesh;
  }
}

// CalculiX prints seven digits.
TEST_F(Reference, OffAxisCantileverBendsAsInCalculiX) {
  const auto scene = cantilever("beam.v22.msh");
  const NodalVector u = scene.nodal(linear_static(scene));
  const NodalVector expected = displacements("C01a_ortho_traction/ccx.csv", u.cols());
  EXPECT_LE((u - expected).cwiseAbs().maxCoeff(), 2e-6 * expected.cwiseAbs().maxCoeff());
}

TEST_F(Reference, StrainEnergyOfTheCantileverIsThatOfGetFem) {
  const auto scene = cantilever("beam.v22.msh");
  EXPECT_NEAR(0.5 * linear_static(scene).dot(scene.force(scene.zero())), 0.005597789027203411, 1e-8 * 0.0056);
}

}  // namespace
}  // namespace orthodyn::statics_test
