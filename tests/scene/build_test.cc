#include <filesystem>

#include "lib/simulation/run/setup.h"
#include "tests/config/messages.h"
#include "tests/scene/scenes.h"

namespace orthodyn::build_test {
namespace {

namespace fs = std::filesystem;

// A scene for natural frequencies needs no time span, without which it cannot be run.
bool can_run(const std::string& file) {
  const Config scene = Config::from_file(file);
  const bool is_of_fit = file.find("/fits/scenes/") != std::string::npos;
  return !is_of_fit || scene.has("time") || scene.has("analysis");
}

// All shipped scenes that can be run, except those whose meshes are not shipped (tests/problems/vega_scenes_test.cc).
std::vector<std::string> shipped_scenes() {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(ORTHODYN_SOURCE_DIR) / "configs")) {
    const auto folder = entry.path().parent_path().filename();
    const bool other =
        folder == "comparisons" || folder == "sweeps" || folder == "stability" || folder == "vega" || folder == "fits";
    if (entry.path().extension() == ".yaml" && !other && can_run(entry.path().string()))
      files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ShippedScenes, EachLoadsBuildsAndMakesItsIntegrator) {
  const auto files = shipped_scenes();
  ASSERT_GE(files.size(), 4u);
  for (const auto& file : files) {
    const Scene scene = read_scene(Config::from_file(file));
    const BuiltScene built = build(scene);
    EXPECT_GT(built.model->num_dofs(), 0) << file;
    if (scene.is_static()) continue;  // static scenes have no integrator
    EXPECT_TRUE(scene.integrator->make(*built.model, task_of(scene, built))) << file;
  }
}

TEST(ResolvedScene, ReadsBackToItself) {
  for (const auto& file : shipped_scenes()) {
    const Config once = Config::from_file(file).resolving();
    read_scene(once);
    const Config twice = Config::from_text(once.dump(), file).resolving();
    read_scene(twice);
    EXPECT_EQ(once.dump(), twice.dump()) << file;
  }
}

TEST(ResolvedScene, SpellsOutDefaultsButNoTermThatIsAbsent) {
  const Config config = Config::from_text(kValidScene).resolving();
  read_scene(config);
  const std::string text = config.dump();
  for (const char* key : {"rtol: 0.0001", "type: auto", "corotation: exact", "split: five"})
    EXPECT_NE(text.find(key), std::string::npos) << key;
  for (const char* key : {"gravity", "damping:", "loads", "initial"})
    EXPECT_EQ(text.find(key), std::string::npos) << key;
}

TEST(ResolvedScene, SaysWhetherPressureFollowsWhichHangsOnTheKinematics) {
  const std::string pressure =
      "\nterms: [{type: pressure, pressure: 1}, {type: pressure, pressure: 1, follows: FOLLOWS}]";
  const auto follows = [&](const std::string& kinematics, const std::string& second) {
    const Config config = Config::from_text(kValidScene + "elasticity: {kinematics: " + kinematics + "}" +
                                            replaced(pressure, "FOLLOWS", second))
                              .resolving();
    read_scene(config);
    return config.at("terms").at(0).at("follows").text() + " " + config.at("terms").at(1).at("follows").text();
  };
  EXPECT_EQ(follows("linear", "true"), "false true");
  EXPECT_EQ(follows("corotational", "false"), "true false");
}

TEST(BuiltScene, HoldsOnlyTheTermsThatItNames) {
  const auto bare = build_text(kValidScene);
  EXPECT_EQ(bare.model->parts().loads.size(), 0u);
  EXPECT_FALSE(bare.model->traits().damping_matrix);
  Linearization at;
  bare.model->linearize(0, bare.initial.q, bare.initial.v, TangentKind::exact, at);
  EXPECT_TRUE(at.damping.empty());

  const auto loaded = build_text(kValidScene + "gravity: [0, 0, -9.81]\ndamping: {stiffness: 0.01}\n");
  EXPECT_EQ(loaded.model->parts().loads.size(), 1u);
  EXPECT_TRUE(loaded.model->traits().damped);
}

TEST(Clamps, RemoveTheirCoordinatesFromTheSystem) {
  EXPECT_EQ(build_text(kValidScene).model->num_dofs(), 3 * 8);
  const auto partly = replaced(kValidScene, "surface: x0", "{surface: x0, components: [x, z]}");
  EXPECT_EQ(build_text(partly).model->num_dofs(), 3 * 8 + 4);
  const auto nearest = replaced(kValidScene, "surface: x0", "nearest: [2.1, 1.1, 1.1]");
  EXPECT_EQ(build_text(nearest).model->num_dofs(), 3 * 12 - 3);
}

TEST(DampedTrait, NeedsStiffnessDampingInEveryRegion) {
  const auto none_here =
      kValidScene + "damping: {stiffness: 0.01}\nregions: {body: {material: soft, stiffness_damping: 0}}\n";
  EXPECT_FALSE(build_text(none_here).model->traits().damped);
  EXPECT_FALSE(build_text(kValidScene + "damping: {mass: 1}\n").model->traits().damped);
}

TEST(InitialState, IsAnAffineMapWithRigidMotionOnTop) {
  const auto free = replaced(kValidScene, "clamps:\n  - surface: x0\n",
                             "initial:\n  velocity: [1, 2, 3]\n  spin: [0, 0, 4]\n  center: [1, 0, 0]\n"
                             "  deformation_gradient: [[1.5, 0, 0], [0, 1, 0.25], [0, 0, 1]]\n");
  const auto built = build_text(free);
  const auto& nodes = built.model->parts().mesh.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 arm = nodes[i] - Vec3(1, 0, 0);
    const Vec3 x(1.5 * arm[0], arm[1] + 0.25 * arm[2], arm[2]);
    const auto at = static_cast<Eigen::Index>(3 * i);
    EXPECT_LT((built.initial.q.segment<3>(at) - (x - arm)).norm(), 1e-15);
    EXPECT_LT((built.initial.v.segment<3>(at) - Vec3(1 - 4 * x[1], 2 + 4 * x[0], 3)).norm(), 1e-14);
  }
}

TEST(Noise, IsTheSameForTheSameSeedAndBounded) {
  const auto with_seed = [](int seed) {
    return build_text(kValidScene + "initial: {noise: {amplitude: 0.01, seed: " + std::to_string(seed) + "}}\n")
        .initial.q;
  };
  EXPECT_EQ(with_seed(3), with_seed(3));
  EXPECT_GT((with_seed(3) - with_seed(4)).norm(), 0.001);
  EXPECT_LE(with_seed(3).cwiseAbs().maxCoeff(), 0.01);
}

TEST(MaterialNotes, AreWarningsOfTheScene) {
  const auto built = build_text(replaced(kValidScene, "soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}",
                                         "odd: {type: orthotropic, density: 1, young: [1, 1, 1], nu12: 0.8, nu23: 0.8, "
                                         "nu13: 0.8, g12: 1, g23: 1, g13: 1, repair: shrink}"));
  ASSERT_FALSE(built.warnings.empty());
  EXPECT_TRUE(starts(built.warnings[0], "material odd: nu12=0.8, nu23=0.8, nu13=0.8 make the stiffness indefinite"));
}

TEST(Regions, HaveTheEntryOfTheirNameBeforeThatOfAll) {
  const Scene scene = read_scene(Config::from_text(R"(
mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], parts: {tip: {min: [1, 0, 0], max: [2, 1, 1]}}, order: 1}
materials:
  soft: {type: isotropic, density: 1, young: 1e6, nu: 0.3}
  hard: {type: isotropic, density: 2, young: 1e9, nu: 0.3}
regions: {tip: {material: hard}, all: {material: soft}}
time: {end: 1}
)"));
  EXPECT_EQ(material_named(scene, entry_of(scene, "tip").second.material).density(), 2);
  EXPECT_EQ(material_named(scene, entry_of(scene, "body").second.material).density(), 1);
  EXPECT_NEAR(build(scene).model->parts().mass->total(), 3, 1e-14);
}

}  // namespace
}  // namespace orthodyn::build_test
