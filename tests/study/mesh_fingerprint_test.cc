// Mesh fingerprints decide which results are reused: any difference that affects a result must change them.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "lib/simulation/run/fingerprints.h"

namespace orthodyn::mesh_fingerprint_test {
namespace {

// Two elements with a common face, each in its own region.
LoadedMesh two_elements() {
  LoadedMesh loaded;
  loaded.mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  loaded.mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 3}, {0, 2, 1, 4}});
  loaded.mesh.region_of = {0, 1};
  loaded.mesh.region_names = {"upper", "lower"};
  loaded.mesh.surfaces = {{"left", {{0, 2, 3}}}, {"right", {{1, 2, 3}, {2, 1, 4}}}};
  loaded.mesh.node_sets = {{"tips", {3, 4}}};
  loaded.materials["lower"].name = "oak";
  loaded.materials["upper"].name = "pine";
  loaded.cell_data = {{"angle", 1, {0, 90}}};
  return loaded;
}

struct Change {
  const char* name;
  std::function<void(LoadedMesh&)> make;
};
void PrintTo(const Change& change, std::ostream* os) { *os << change.name; }

class MeshFingerprint : public testing::TestWithParam<Change> {};

TEST_P(MeshFingerprint, IsAnotherAfterTheChange) {
  LoadedMesh changed = two_elements();
  GetParam().make(changed);
  EXPECT_NE(mesh_fingerprint(changed), mesh_fingerprint(two_elements()));
}

const Change kOfTheMesh[] = {
    {"a_coordinate_by_one_bit", [](LoadedMesh& m) { m.mesh.nodes[3][2] += std::numeric_limits<double>::epsilon(); }},
    {"the_order_of_nodes", [](LoadedMesh& m) { std::swap(m.mesh.nodes[3], m.mesh.nodes[4]); }},
    {"the_order_of_elements",
     [](LoadedMesh& m) {
       m.mesh.cells = Cells(std::vector<Tet>{{0, 2, 1, 4}, {0, 1, 2, 3}});
     }},
    {"the_order_within_an_element",
     [](LoadedMesh& m) {
       m.mesh.cells = Cells(std::vector<Tet>{{1, 2, 0, 3}, {0, 2, 1, 4}});
     }},
    {"an_element_less",
     [](LoadedMesh& m) {
       m.mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 3}}), m.mesh.region_of.pop_back();
     }},
    {"the_region_of_an_element", [](LoadedMesh& m) { m.mesh.region_of[1] = 0; }},
    {"the_name_of_a_region", [](LoadedMesh& m) { m.mesh.region_names[0] = "top"; }},
    {"the_border_between_names",
     [](LoadedMesh& m) {
       m.mesh.region_names = {"upperl", "ower"};
     }},
    {"a_triangle_of_a_surface",
     [](LoadedMesh& m) {
       m.mesh.surfaces["left"][0] = {0, 2, 4};
     }},
    {"the_side_of_a_triangle",
     [](LoadedMesh& m) {
       m.mesh.surfaces["left"][0] = {0, 3, 2};
     }},
    {"the_name_of_a_surface",
     [](LoadedMesh& m) {
       m.mesh.surfaces["west"] = m.mesh.surfaces["left"];
       m.mesh.surfaces.erase("left");
     }},
    {"a_triangle_of_another_surface",
     [](LoadedMesh& m) {
       m.mesh.surfaces["left"].push_back(m.mesh.surfaces["right"].front());
       m.mesh.surfaces["right"].erase(m.mesh.surfaces["right"].begin());
     }},
    {"a_set_of_nodes", [](LoadedMesh& m) { m.mesh.node_sets["tips"] = {3}; }},
    {"the_element_that_a_tet_was_cut_from",
     [](LoadedMesh& m) {
       m.mesh.cell_of = {0, 0};
     }},
    {"a_further_set_of_nodes", [](LoadedMesh& m) { m.mesh.node_sets["none"] = {}; }}};
INSTANTIATE_TEST_SUITE_P(Mesh, MeshFingerprint, testing::ValuesIn(kOfTheMesh),
                         [](const auto& tested) { return std::string(tested.param.name); });

const Change kOfTheFile[] = {
    {"a_modulus", [](LoadedMesh& m) { m.materials["lower"].young[2] = 1; }},
    {"a_shear_modulus", [](LoadedMesh& m) { m.materials["lower"].g31 = 1; }},
    {"a_poisson_number", [](LoadedMesh& m) { m.materials["lower"].nu23 = 0.1; }},
    {"a_density", [](LoadedMesh& m) { m.materials["lower"].density = 1; }},
    {"an_axis", [](LoadedMesh& m) { m.materials["lower"].axes = Eigen::AngleAxisd(1, Vec3::UnitZ()).matrix(); }},
    {"the_kind_of_a_material", [](LoadedMesh& m) { m.materials["lower"].kind = MeshMaterial::Kind::orthotropic; }},
    {"materials_the_other_way_round", [](LoadedMesh& m) { std::swap(m.materials["lower"], m.materials["upper"]); }},
    {"a_value_of_an_element", [](LoadedMesh& m) { m.cell_data[0].values[1] = 80; }},
    {"the_name_of_values", [](LoadedMesh& m) { m.cell_data[0].name = "angles"; }},
    {"the_components_of_values", [](LoadedMesh& m) { m.cell_data[0].components = 2; }}};
INSTANTIATE_TEST_SUITE_P(File, MeshFingerprint, testing::ValuesIn(kOfTheFile),
                         [](const auto& tested) { return std::string(tested.param.name); });

// Independent of file name and comments.
TEST(EqualMeshes, HaveEqualFingerprints) {
  LoadedMesh again = two_elements();
  again.warnings.push_back("a node that no element uses was removed");
  again.materials["lower"].where = "other.veg:12";
  EXPECT_EQ(mesh_fingerprint(again), mesh_fingerprint(two_elements()));
  EXPECT_EQ(mesh_fingerprint(again.mesh), mesh_fingerprint(two_elements().mesh));
}

}  // namespace
}  // namespace orthodyn::mesh_fingerprint_test
