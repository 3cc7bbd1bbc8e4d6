// Writing and reading gives the same mesh, as far as the format can represent it.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <set>

#include "lib/mesh/box.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::round_trip_test {
namespace {

// Two alternating regions, a boundary surface, an inner surface, a node set, and coordinates with all digits.
LoadedMesh sample() {
  LoadedMesh loaded;
  loaded.mesh = make_box({.size = Vec3(1, 2, 3) / 3, .cells = {2, 1, 1}});
  Mesh& mesh = loaded.mesh;
  mesh.region_names = {"region1", "region2"};
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) mesh.region_of[e] = static_cast<int>(e % 2);
  const auto x0 = mesh.surfaces.at("x0");
  const Tet central = tets_of(mesh)[0];
  mesh.surfaces = {{"marker1", x0}, {"marker2", {{central[0], central[1], central[2]}}}};
  mesh.node_sets = {{"marker3", {0, 3, 4}}};
  validate(mesh, {"sample"});
  return loaded;
}

LoadedMesh through(const std::string& ending, const LoadedMesh& loaded, Warnings* losses = nullptr) {
  const TemporaryFolder folder;
  const Warnings lost = write_mesh(loaded, folder.path("mesh" + ending), false);
  if (losses) *losses = lost;
  return read_mesh(folder.path("mesh" + ending));
}

class RoundTrip : public testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, KeepsNodesElementsAndRegionsToTheLastDigit) {
  const LoadedMesh loaded = sample();
  const Mesh mesh = through(GetParam(), loaded).mesh;
  EXPECT_EQ(mesh.nodes, loaded.mesh.nodes);
  EXPECT_EQ(mesh.cells, loaded.mesh.cells);
  EXPECT_EQ(mesh.region_names, loaded.mesh.region_names);
  EXPECT_EQ(mesh.region_of, loaded.mesh.region_of);
}

TEST_P(RoundTrip, KeepsOrNamesSurfacesAndNodeSets) {
  const LoadedMesh loaded = sample();
  Warnings losses;
  const Mesh mesh = through(GetParam(), loaded, &losses).mesh;
  std::string said;
  for (const std::string& loss : losses) said += loss + "\n";
  for (const auto& [name, triangles] : loaded.mesh.surfaces) {
    if (!mesh.surfaces.contains(name)) {
      EXPECT_CONTAINS(said, name);
      continue;
    }
    ASSERT_EQ(mesh.surfaces.at(name).size(), triangles.size()) << name;
    for (std::size_t t = 0; t < triangles.size(); ++t) {  // the same nodes, the same way round
      FaceCorners read = mesh.surfaces.at(name)[t];
      for (int turn = 0; turn < 3 && read != triangles[t]; ++turn)
        std::rotate(read.begin(), read.begin() + 1, read.end());
      EXPECT_EQ(read, triangles[t]) << name;
    }
  }
  if (mesh.node_sets.contains("marker3")) {
    EXPECT_EQ(mesh.node_sets, loaded.mesh.node_sets);
  } else {
    EXPECT_CONTAINS(said, "marker3");
  }
}

std::vector<std::string> endings_that_are_written() {
  std::vector<std::string> endings;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.write) endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  }
  return endings;
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::ValuesIn(endings_that_are_written()),
                         [](const auto& test) { return test.param.substr(1); });

TEST(MeshFormats, NoTwoHaveTheSameEnding) {
  std::set<std::string> endings;
  for (const MeshFormat& format : mesh_formats()) {
    for (const std::string& ending : format.endings) EXPECT_TRUE(endings.insert(ending).second) << ending;
  }
  EXPECT_EQ(mesh_format_of("BEAM.MSH").name, "Gmsh");
}

TEST(WrittenVega, KeepsMaterialsAxesAndTheFixedNodes) {
  LoadedMesh loaded = sample();
  MeshMaterial wood{.name = "wood",
                    .kind = MeshMaterial::Kind::orthotropic,
                    .density = 400,
                    .young = {3, 2, 1},
                    .nu12 = .1,
                    .nu23 = .2,
                    .nu31 = .3,
                    .g12 = 12,
                    .g23 = 23,
                    .g31 = 31};
  wood.axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  MeshMaterial steel{
      .name = "steel", .density = 7800, .young = Vec3::Constant(2e11), .nu12 = .3, .nu23 = .3, .nu31 = .3};
  loaded.materials = {{"region1", wood}, {"region2", steel}};
  const LoadedMesh read = through(".veg", loaded);
  EXPECT_EQ(read.materials.at("region1").axes, wood.axes);
  EXPECT_EQ(read.materials.at("region1").nu31, 0.3);
  EXPECT_EQ(read.materials.at("region1").g23, 23);
  EXPECT_EQ(read.materials.at("region2").young[0], 2e11);
  EXPECT_EQ(read.materials.at("region2").kind, MeshMaterial::Kind::isotropic);
}

TEST(WrittenVtu, KeepsNamesAndCellData) {
  LoadedMesh loaded = sample();
  loaded.mesh.region_names = {"soft wood", "<\"&>"};
  loaded.cell_data = {{"axis 1", 3, std::vector<double>(3 * loaded.mesh.cells.size(), 0.1)}};
  const LoadedMesh read = through(".vtu", loaded);
  EXPECT_EQ(read.mesh.region_names, loaded.mesh.region_names);
  ASSERT_TRUE(find_cell_data(read, "axis 1"));
  EXPECT_EQ(find_cell_data(read, "axis 1")->values, loaded.cell_data[0].values);
}

// A format may change names; it reports that, and regions stay distinct.
class NamesThatAreAlike : public testing::TestWithParam<const char*> {};

TEST_P(NamesThatAreAlike, AreStillSeveralRegions) {
  LoadedMesh loaded = sample();
  Mesh& mesh = loaded.mesh;
  mesh.region_names = {"a b", "a_b", "A_B", "x, y=1", "x", "\"x\"", " x "};
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    mesh.region_of[e] = static_cast<int>(e % mesh.region_names.size());
  mesh.node_sets.clear();
  Warnings losses;
  const Mesh read = through(GetParam(), loaded, &losses).mesh;
  ASSERT_EQ(read.region_names.size(), mesh.region_names.size());
  EXPECT_EQ(read.region_of, mesh.region_of);
  std::string said;
  for (const std::string& loss : losses) said += loss + "\n";
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
    if (read.region_names[r] == mesh.region_names[r]) continue;
    EXPECT_CONTAINS(said, "the name \"" + mesh.region_names[r] + "\" became \"" + read.region_names[r] + "\"");
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, NamesThatAreAlike, testing::Values(".veg", ".inp"));

TEST(WrittenAbaqus, KeepsNamesWithCommasAndSetsThatDifferInCapitals) {
  LoadedMesh loaded = sample();
  loaded.mesh.region_names = {"x, y=1", "rest"};
  loaded.mesh.node_sets = {{"Tip", {0}}, {"tip", {1}}};
  const Mesh read = through(".inp", loaded).mesh;
  EXPECT_EQ(read.region_names, loaded.mesh.region_names);
  ASSERT_EQ(read.node_sets.size(), 2u);
  EXPECT_EQ(read.node_sets.at("Tip"), std::vector<int>{0});
  EXPECT_EQ(read.node_sets.at("tip_2"), std::vector<int>{1});
}

// Other readers treat quotes as part of the name.
TEST(WrittenAbaqus, QuotesOnlyTheNamesThatNeedIt) {
  LoadedMesh loaded = sample();
  loaded.mesh.region_names = {"oak-2", "x, y=1"};
  const std::string text = write_abaqus(loaded).files.at(0).text;
  EXPECT_NE(text.find("ELSET=oak-2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("ELSET=\"x, y=1\"\n"), std::string::npos) << text;
}

TEST(WrittenVega, MaterialsWhoseNamesAreAlikeStayTwo) {
  LoadedMesh loaded = sample();
  MeshMaterial soft{.name = "a b", .density = 1, .young = Vec3::Constant(1), .nu12 = .3, .nu23 = .3, .nu31 = .3};
  MeshMaterial hard = soft;
  hard.young = Vec3::Constant(2);
  for (const char* name : {"a_b", "a b"}) {  // another spelling, and even the same
    hard.name = name;
    loaded.materials = {{"region1", soft}, {"region2", hard}};
    const LoadedMesh read = through(".veg", loaded);
    EXPECT_EQ(read.materials.at("region1").young[0], 1) << name;
    EXPECT_EQ(read.materials.at("region2").young[0], 2) << name;
  }
}

TEST(WriteMesh, ReplacesNothingUnasked) {
  const TemporaryFolder folder;
  folder.write("mesh.ele", "mine");
  EXPECT_CONTAINS(refusal_of([&] { write_mesh(sample(), folder.path("mesh.node"), false); }),
                  "mesh.ele: already exists; --force");
  EXPECT_FALSE(std::filesystem::exists(folder.path("mesh.node")));
  write_mesh(sample(), folder.path("mesh.node"), true);
  EXPECT_EQ(read_mesh(folder.path("mesh.ele")).mesh.cells, sample().mesh.cells);
}

// During its lifetime no file can exceed `bytes`, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(WriteMesh, AFullDiskCostsNoneOfTheFilesThatAreThere) {
  LoadedMesh loaded;
  loaded.mesh = make_box({.size = Vec3(4, 4, 4), .cells = {4, 4, 4}});
  for (const char* name : {"mesh.msh", "mesh.node"}) {
    const TemporaryFolder folder;
    write_mesh(loaded, folder.path(name), false);
    const auto files = [&] {
      std::map<std::string, std::string> all;
      for (const auto& entry : std::filesystem::directory_iterator(folder.path(""))) {
        std::ifstream stream(entry.path(), std::ios::binary);
        all[entry.path().filename()] = std::string(std::istreambuf_iterator<char>(stream), {});
      }
      return all;
    };
    const auto before = files();
    std::string message;
    {
      const FullDisk full(4000);  // room for the .node file, not for the .ele file
      message = refusal_of([&] {
        LoadedMesh scaled = loaded;
        scale_mesh(scaled.mesh, 2, "m");
        write_mesh(scaled, folder.path(name), true);
      });
    }
    EXPECT_CONTAINS(message, "cannot be written");
    EXPECT_TRUE(files() == before) << name;
  }
}

TEST(WriteMesh, ScalingMultipliesLengthsAndRefusesWhatCannotBeRepresented) {
  Mesh mesh = sample().mesh;
  const double volume = cell_volume(mesh, 0);
  scale_mesh(mesh, 2, "m");
  EXPECT_NEAR(6 * cell_volume(mesh, 0), 6 * 8 * volume, 1e-15);
  EXPECT_CONTAINS(refusal_of([&] { scale_mesh(mesh, 1e-110, "m"); }), "cannot be represented; check the scale");
}

}  // namespace
}  // namespace orthodyn::round_trip_test
