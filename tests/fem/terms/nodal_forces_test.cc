// Nodal forces from a file: assignment to nodes, and error messages with line numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/config/messages.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::nodal_forces_test {
namespace {

class NodalForcesOfAFile : public testing::Test {
 protected:
  static std::string write(const std::string& content) {
    const auto path = std::filesystem::path(testing::TempDir()) /
                      fmt::format("nodal_forces_{}.csv", testing::UnitTest::GetInstance()->current_test_info()->name());
    std::ofstream(path) << content;
    return path.string();
  }

  // A cube of 27 nodes, side 2 m.
  static BuiltTestScene cube(const std::string& content, const std::string& keys = "") {
    return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [2, 2, 2], cells: [2, 2, 2], order: 1}}
materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0.3}}}}
elasticity: {{kinematics: linear}}
terms: [{{type: nodal_forces, file: "{}"{}}}]
time: {{end: 1}}
)",
                                      write(content), keys));
  }

  static NodalVector forces(const std::string& content, const std::string& keys = "") {
    const auto s = cube(content, keys);
    return s.nodal(s.force(s.zero()));
  }

  static std::string refused(const std::string& content, const std::string& keys = "") {
    return refusal([&] { cube(content, keys); });
  }
};

TEST_F(NodalForcesOfAFile, AreThoseOfTheNumberedNodes) {
  const NodalVector f = forces("# two\nnode,fx,fy,fz\n26,1,2,3\n\n0,-4,5,0.5\n");
  NodalVector expected = NodalVector::Zero(3, 27);
  expected.col(26) = Vec3(1, 2, 3);
  expected.col(0) = Vec3(-4, 5, 0.5);
  EXPECT_EQ(f, expected);
}

TEST_F(NodalForcesOfAFile, AreThoseOfTheNodesAtThePlaces) {
  const auto s = cube("fz,x,y,z,fx,fy\n3,2,1,0,1,2\n0.5,0.0000001,0,2,-4,5\n");
  const NodalVector f = s.nodal(s.force(s.zero()));
  EXPECT_EQ(f.col(nearest_node(s.mesh(), {2, 1, 0})), Vec3(1, 2, 3));
  EXPECT_EQ(f.col(nearest_node(s.mesh(), {0, 0, 2})), Vec3(-4, 5, 0.5));
  EXPECT_EQ((f.array() != 0).count(), 6);
}

TEST_F(NodalForcesOfAFile, GoToTheNearestNodeWithinTheTolerance) {
  const auto s = cube("x,y,z,fx,fy,fz\n1.4,0.6,0.9,1,0,0\n", ", tolerance: 70 cm");
  EXPECT_EQ(s.nodal(s.force(s.zero())).col(nearest_node(s.mesh(), {1, 1, 1})), Vec3(1, 0, 0));
}

TEST_F(NodalForcesOfAFile, FollowTheirFactorAndDoWork) {
  const auto s = cube("node,fx,fy,fz\n3,1,2,3\n5,0,1,0\n", ", factor: {type: ramp, end: 2, value: 4}");
  const Vector half = s.force(s.zero(), s.zero(), 1);
  EXPECT_EQ(s.nodal(half).col(3), Vec3(2, 4, 6));
  const Vector v = s.dofs([](const Vec3& X) { return Vec3(X[1], 2 * X[2], 3 * X[0]); });
  EXPECT_NEAR(s.built.model->evaluate("power.loads", {1, s.zero(), v})[0], half.dot(v), 1e-13);
  EXPECT_EQ(s.model().parts().loads.at(0)->description(),
            "nodal forces of nodal_forces_FollowTheirFactorAndDoWork.csv: 2 nodes, [1, 3, 3] N in total at factor 1");
}

TEST_F(NodalForcesOfAFile, LeaveALinearModelLinear) {
  EXPECT_TRUE(cube("node,fx,fy,fz\n3,1,2,3\n").model().traits().linear);
  EXPECT_TRUE(cube("node,fx,fy,fz\n3,1,2,3\n").model().traits().conservative);
}

TEST_F(NodalForcesOfAFile, AreRefusedWithTheirLine) {
  const std::string numbered = "node,fx,fy,fz\n", placed = "x,y,z,fx,fy,fz\n";
  EXPECT_TRUE(holds(refused(numbered + "27,1,2,3\n"), ".csv:2: node 27 does not exist; the mesh has 0 to 26"));
  EXPECT_TRUE(holds(refused(numbered + "0,1,2,3\n-1,1,2,3\n"), ".csv:3: column node: expected a whole number from 0"));
  EXPECT_TRUE(holds(refused(numbered + "1.5,1,2,3\n"), ".csv:2: column node: expected a whole number from 0"));
  EXPECT_TRUE(holds(refused(numbered + "4,1,2,3\n5,1,2,3\n4,1,2,3\n"), ".csv:4: node 4 already has a row, in line 2"));
  EXPECT_TRUE(holds(refused(numbered + "4,1,nan,3\n"), ".csv:2: column fy: expected a finite number, found 'nan'"));
  EXPECT_TRUE(holds(refused(numbered + "4,1,2\n"), ".csv:2: found 3 entries where 4 columns are named"));
  EXPECT_TRUE(holds(refused(placed + "0,0,0,1,2,3\n0,0,0,1,2,3\n"), ".csv:3: node 0 already has a row, in line 2"));
  const auto far = refused(placed + "2,2,2,1,2,3\n0.1,0,0,1,2,3\n");
  EXPECT_TRUE(holds(far, ".csv:3: no node within 3.46e-06 m of [0.1, 0, 0]"));
  EXPECT_TRUE(holds(far, "the nearest is node 0 at [0, 0, 0], 0.1 m away"));
}

TEST_F(NodalForcesOfAFile, AreRefusedWithoutClearColumns) {
  EXPECT_TRUE(holds(refused("fx,fy,fz\n1,2,3\n"), "give node,fx,fy,fz or x,y,z,fx,fy,fz"));
  EXPECT_TRUE(holds(refused("x,y,fx,fy,fz\n1,2,3,4,5\n"), "give node,fx,fy,fz or x,y,z,fx,fy,fz"));
  EXPECT_TRUE(holds(refused("node,x,y,z,fx,fy,fz\n0,0,0,0,1,2,3\n"), "give node,fx,fy,fz or x,y,z,fx,fy,fz"));
  EXPECT_TRUE(holds(refused("node,fx,fy\n0,1,2\n"), ".csv:1: column 'fz' is missing"));
  EXPECT_TRUE(holds(refused("node,fx,fy,fz\n"), "no rows of numbers"));
  EXPECT_TRUE(holds(refused("node,fx,fy,fz\n0,1,2,3\n", ", tolerance: 1"), "the columns x,y,z only"));
}

}  // namespace
}  // namespace orthodyn::nodal_forces_test
