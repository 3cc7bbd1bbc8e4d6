#include <dlfcn.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "lib/core/versions.h"
#include "lib/mesh/box.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/simulation/output/json.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::command_line_test {
namespace {

using CommandLine = InFolder;

TEST_F(CommandLine, AMistypedCommandIsNamedWithTheNearestOne) {
  const auto result = orthodyn("rnu swing.yaml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("unknown command 'rnu'; did you mean 'run'?"), std::string::npos) << result.output;
  EXPECT_NE(orthodyn("--plugin").exit_code, 0);
  EXPECT_NE(orthodyn("").output.find("subcommand is required"), std::string::npos);
}

// Path of the shared library that contains a function.
template <class Function>
std::string library_of(Function* function) {
  Dl_info info{};
  dladdr(reinterpret_cast<const void*>(function), &info);
  return fs::absolute(info.dli_fname).string();
}

TEST_F(CommandLine, APluginIsRefusedBeforeAndAfterTheCommandUnlessItAddsSomething) {
  write("text.so", "no library");
  const std::pair<std::string, std::string> files[] = {
      {"nowhere.so", "--plugin nowhere.so: no such file"},
      {"text.so", "text.so cannot be loaded"},
      {library_of(&std::fflush), "adds nothing: no material, term"},
      {library_of(&orthodyn_version), "adds nothing: no material, term"}};
  for (const auto& [file, says] : files) {
    for (const auto& arguments : {"--plugin " + file + " list axes", "list axes --plugin " + file}) {
      const auto refused = orthodyn(arguments);
      EXPECT_EQ(refused.exit_code, 2) << arguments;
      EXPECT_NE(refused.output.find(says), std::string::npos) << arguments << "\n" << refused.output;
      EXPECT_EQ(refused.output.find("axis_angle"), std::string::npos) << "it went on";
    }
  }
}

// `check` predicts a lower bound of the critical step. It must not exceed the critical step found in the run, with and
// without damping.
TEST_F(CommandLine, CheckTellsACriticalStepThatHolds) {
  write("swing.yaml", kSwing);
  const auto number_after = [](const std::string& text, const std::string& words) {
    const auto at = text.find(words);
    return at == std::string::npos ? 0 : std::stod(text.substr(at + words.size()));
  };
  for (const char* damping : {"null", "{stiffness: 0.01}", "{stiffness: 1}"}) {
    const std::string with_damping = std::string(" swing.yaml --set time.end=1 --set 'damping=") + damping + "'";
    const double told =
        number_after(orthodyn("check" + with_damping).output, "critical step of an explicit scheme at least ");
    const auto run =
        orthodyn("run" + with_damping + " --set 'integrator={type: central_differences, step: 0.5}'").output;
    const double found = number_after(run, "above the critical step, ");
    EXPECT_GT(told, 0) << damping;
    EXPECT_LE(told, found) << damping << run;
    EXPECT_GT(told, 0.2 * found) << damping << run;
  }
}

TEST_F(CommandLine, CheckTellsTheInertiaOfRigidBodies) {
  const std::string body = "regions:\n  body: {material: m, rigid: ";
  const std::string rest =
      "}\nmesh: {type: box, size: [1, 0.4, 0.2], cells: [1, 1, 1], order: 1}\n"
      "materials: {m: {type: isotropic, density: 50, young: 1e4, nu: 0.3}}\ntime: {end: 1}\n";
  write("mesh.yaml", body + "true" + rest);
  write("given.yaml", body + "{mass: 1.5, center: [0.5, 0, 0.1], inertia: [2, 3, 4, 0, 0, 0]}" + rest);
  for (const auto& [file, says] :
       {std::pair("mesh.yaml", "mass 4 kg, centre [0.5, 0.2, 0.1] m, principal moments 0.06667, 0.3467, 0.3867 kg m^2"),
        std::pair("given.yaml", "mass 1.5 kg, centre [0.5, 0, 0.1] m, principal moments 2, 3, 4 kg m^2")}) {
    const auto result = orthodyn(std::string("check ") + file);
    EXPECT_NE(result.output.find(says), std::string::npos) << result.output;
  }
}

// A rigid body that a joint holds.
TEST_F(CommandLine, CheckTellsOfNoCriticalStepWithoutElasticity) {
  write("rod.yaml", R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
regions: {body: {material: m, rigid: true}}
joints: [{type: ball, name: foot, at: [0, 0, 0], first: {region: body}}]
gravity: [0, 0, -10]
time: {end: 1}
)");
  const auto result = orthodyn("check rod.yaml");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("no critical step of an explicit scheme"), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("inf s"), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("the body is free"), std::string::npos) << result.output;
  write("swing.yaml", kSwing);
  EXPECT_NE(orthodyn("check swing.yaml --set 'clamps=[]'").output.find("none: the body is free"), std::string::npos);
}

TEST_F(CommandLine, APluginBeforeTheSceneLeavesTheSceneAlone) {
  write("text.so", "no library");
  const auto refused = orthodyn("check --plugin text.so swing.yaml");
  EXPECT_NE(refused.output.find("text.so cannot be loaded"), std::string::npos) << refused.output;
}

TEST_F(CommandLine, RunWritesEverythingThatItPromises) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  for (const char* name : {"scene.yaml", "run.json", "frames.pvd", "energy.csv", "steps.csv", "probes.csv",
                           "frames/frame_00000.vtu", "frames/frame_00005.vtu"})
    EXPECT_TRUE(fs::exists(folder_ / "out/swing" / name)) << name;
  EXPECT_FALSE(fs::exists(folder_ / "out/swing/frames/frame_00006.vtu"));
  for (const char* word :
       {"steps", "force", "tangent", "factorisation", "solve", "balance drift", "det F", "max_order"})
    EXPECT_NE(result.output.find(word), std::string::npos) << word;
  EXPECT_NE(read_text(folder_ / "out/swing/run.json").find("\"completed\""), std::string::npos);
}

TEST_F(CommandLine, TheResolvedSceneRunsToTheSameResult) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  const auto again = orthodyn("run out/swing/scene.yaml --quiet --out again");
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(read_text(folder_ / "out/swing/probes.csv"), read_text(folder_ / "again/probes.csv"));
}

TEST_F(CommandLine, ReactionsAreRecordedWhereTheSceneAsksForThem) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --set output.reactions=true --set clamps.0.name=wall").exit_code, 0);
  const std::string probes = read_text(folder_ / "out/swing/probes.csv"), header = probes.substr(0, probes.find('\n'));
  EXPECT_EQ(header,
            "t [s],tip.displacement.x [m],tip.displacement.y [m],tip.displacement.z [m],reaction.wall.x "
            "[N],reaction.wall.y [N],reaction.wall.z [N],torque.wall.x [N m],torque.wall.y [N m],torque.wall.z [N m]");
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --force").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "out/swing/probes.csv").find("reaction"), std::string::npos);
}

TEST_F(CommandLine, FramesConvertBackToTheMesh) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  const auto converted = orthodyn("convert out/swing/frames/frame_00000.vtu back.msh");
  ASSERT_EQ(converted.exit_code, 0) << converted.output;
  const Mesh back = read_mesh((folder_ / "back.msh").string()).mesh;
  const Mesh box = make_box({.size = Vec3(1, 0.2, 0.2), .cells = {4, 1, 1}});
  EXPECT_EQ(back.nodes, box.nodes);
  EXPECT_EQ(back.cells, box.cells);
}

TEST_F(CommandLine, AnEarlierResultIsKeptUnlessForced) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  const auto before = read_text(folder_ / "out/swing/probes.csv");
  const auto refused = orthodyn("run swing.yaml --quiet --set gravity.2=-2");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("--force"), std::string::npos);
  EXPECT_EQ(read_text(folder_ / "out/swing/probes.csv"), before);
  EXPECT_EQ(orthodyn("run swing.yaml --quiet --force --set gravity.2=-2").exit_code, 0);
  EXPECT_NE(read_text(folder_ / "out/swing/probes.csv"), before);
}

TEST_F(CommandLine, ABadSceneLeavesAnEarlierResultAloneEvenWithForce) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  EXPECT_EQ(orthodyn("run swing.yaml --quiet --force --set time.end=-1").exit_code, 2);
  EXPECT_TRUE(fs::exists(folder_ / "out/swing/frames/frame_00005.vtu"));
}

TEST_F(CommandLine, ForceDoesNotTouchAFolderOfSomethingElse) {
  write("swing.yaml", kSwing);
  fs::create_directories(folder_ / "mine");
  write("mine/thesis.txt", "years of work");
  const auto result = orthodyn("run swing.yaml --force --out mine");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(read_text(folder_ / "mine/thesis.txt"), "years of work");
}

TEST_F(CommandLine, BadInputExitsWith2AndWritesNothing) {
  write("swing.yaml", kSwing);
  write("torn.yaml", "mesh: {type: box\nmaterials: [");
  write("binary.yaml", std::string("\x7f\x45\x4c\x46\0\1\2\3", 8));
  for (const std::string arguments :
       {"run nowhere.yaml", "run torn.yaml", "run binary.yaml", "run .", "run swing.yaml --set gravity=[0,0]",
        "run swing.yaml --set nothing", "run swing.yaml --set mesh.cells.7=1", "run swing.yaml --integrator cvode_bfd",
        "run swing.yaml --set output.fields=[displacment]",
        "run swing.yaml --set elasticity.kinematics=linear --set elasticity.corotation=warped",
        "run swing.yaml --set elasticity.warped_tangent=unsymmetric",
        "run swing.yaml --set integrator.h_min=1 --set integrator.h_max=0.1",
        "run swing.yaml --set materials.soft.young=.inf", "check swing.yaml --set clamps.0.surface=x7", "run",
        "fly swing.yaml", "list gravity"}) {
    const auto result = orthodyn(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.output;
    EXPECT_FALSE(result.output.empty()) << arguments;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CommandLine, ASetValueIsNamedWhenItIsAtFault) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml --set materials.soft.nu=0.7");
  EXPECT_NE(result.output.find("swing.yaml: --set materials.soft.nu: must be in (-1, 0.5), found 0.7"),
            std::string::npos)
      << result.output;
}

TEST_F(CommandLine, ARunThatCannotGoOnExitsWith3AndKeepsItsFrames) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml --set integrator.max_steps=12 --set integrator.h_max=0.01");
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_NE(result.output.find("max_steps"), std::string::npos) << result.output;
  EXPECT_TRUE(fs::exists(folder_ / "out/swing/frames/frame_00000.vtu"));
  const auto json = read_text(folder_ / "out/swing/run.json");
  for (const char* word :
       {"\"failed\"", "\"failure\"", "\"time\"", "element_with_smallest_det_f", "fastest_node", "raise"})
    EXPECT_NE(json.find(word), std::string::npos) << word;
}

TEST_F(CommandLine, AnotherIntegratorTakesOverTheKeysThatItHas) {
  write("beam.yaml", R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
time: {end: 0.1}
integrator: {type: cvode_bdf, rtol: 1e-3, max_order: 4}
)");
  const auto result = orthodyn("run beam.yaml --integrator newmark");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("max_order is not used by newmark and is left out"), std::string::npos) << result.output;
  const auto scene = read_text(folder_ / "out/beam/scene.yaml");
  EXPECT_NE(scene.find("newmark"), std::string::npos);
  EXPECT_NE(scene.find("0.001"), std::string::npos) << scene;  // the value of rtol
  EXPECT_EQ(orthodyn("check beam.yaml --integrator ida_bdf").output.find("not used by"), std::string::npos);
}

TEST_F(CommandLine, TheCommitIsRecordedAndScalesAreShort) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml");
  EXPECT_NE(read_text(folder_ / "out/swing/run.json").find("\"commit\": \"" + orthodyn_commit() + "\""),
            std::string::npos);
  const auto at = result.output.find("velocity_scale");
  ASSERT_NE(at, std::string::npos) << result.output;
  const std::string line = result.output.substr(at, result.output.find('\n', at) - at);
  EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return std::isdigit(c) != 0; }), 6) << line;
}

TEST_F(CommandLine, AFullDiskEndsTheRunWithWholeFrames) {
  write("swing.yaml", kSwing);
  // Limits the size of files to 20 kB, less than the first frame.
  const auto result = shell("cd " + folder_.string() + " && trap '' XFSZ; ulimit -f 40; " + program() +
                            " run swing.yaml --quiet --set 'mesh.cells=[16, 4, 4]'");
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_NE(result.output.find("cannot write"), std::string::npos) << result.output;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  EXPECT_NE(read_text(folder_ / "out/swing/run.json").find("\"failed\""), std::string::npos);
}

// The method accepts a step to a state whose energy is infinite.
TEST_F(CommandLine, ARunThatCannotBeObservedSaysWhen) {
  write("crushed.yaml", R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
regions: {body: {material: m, law: neo_hookean}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-9000, 0, 0]}]
time: {end: 1}
integrator: {type: energy_momentum, step: 0.05}
)");
  const auto result = orthodyn("run crushed.yaml --quiet");
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_NE(result.output.find("error: the state at t = 0."), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("s cannot be evaluated (an element is inverted"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("lower integrator.step"), std::string::npos) << result.output;
}

TEST_F(CommandLine, ListsStrengthsReactionsAndBuckling) {
  EXPECT_NE(orthodyn("list presets").output.find("strengths along 1, 2, 3: tension 70, 2.6, 2.6"), std::string::npos);
  EXPECT_NE(orthodyn("list quantities").output.find("reaction.SUPPORT"), std::string::npos);
  EXPECT_NE(orthodyn("list buckling").output.find("critical load factors"), std::string::npos);
}

// Each type of joint has the keys that it can take.
TEST_F(CommandLine, ListsJointsAndTheirQuantities) {
  const std::string joints = orthodyn("list joints").output;
  const auto part = [&](const std::string& from, const std::string& to) {
    const auto begin = joints.find("\n  " + from + "\n"), end = joints.find("\n  " + to + "\n");
    return begin < end && end != std::string::npos ? joints.substr(begin, end - begin) : "";
  };
  const auto has = [](const std::string& text, const std::string& key) {
    return text.find("\n    " + key + " ") != std::string::npos;
  };
  const std::string ball = part("ball", "hinge"), hinge = part("hinge", "distance");
  EXPECT_TRUE(has(ball, "at")) << joints;
  EXPECT_FALSE(has(ball, "from")) << ball;
  EXPECT_FALSE(has(ball, "spring")) << ball;
  EXPECT_FALSE(has(hinge, "at")) << hinge;
  EXPECT_TRUE(has(hinge, "from")) << hinge;
  EXPECT_TRUE(has(hinge, "motor")) << hinge;
  EXPECT_FALSE(has(hinge, "along")) << hinge;
  const std::string distance = part("distance", "slot"), cylindrical = part("cylindrical", "slider");
  EXPECT_TRUE(has(distance, "motor")) << distance;
  EXPECT_FALSE(has(distance, "spring")) << distance;
  EXPECT_TRUE(has(cylindrical, "along")) << cylindrical;
  const std::string strut = part("strut", "joints.<n>.first");
  EXPECT_TRUE(has(strut, "spring")) << joints;
  EXPECT_FALSE(has(strut, "motor")) << strut;
  const std::string quantities = orthodyn("list quantities").output;
  for (const char* name : {"joint.JOINT", "coordinate.JOINT", "slide.JOINT, angle.JOINT", "motor.JOINT", "joints.gap",
                           "joints.rate", "tie.TIE"})
    EXPECT_NE(quantities.find(name), std::string::npos) << name;
}

// energy.balance_drift (J) in run.json of out/swing.
double balance_drift(const fs::path& folder) {
  return Json::parse(read_text(folder / "out/swing/run.json")).at("energy").at("balance_drift");
}

TEST_F(CommandLine, DriftIsThatOfTheRowsOfEnergyCsv) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml");
  EXPECT_NE(result.output.find("of the largest energy, at the outputs"), std::string::npos) << result.output;
  double largest = 0;
  for (const auto& row : read_rows(folder_ / "out/swing/energy.csv")) largest = std::max(largest, std::abs(row.back()));
  EXPECT_GT(largest, 0);
  EXPECT_DOUBLE_EQ(balance_drift(folder_), largest);
}

TEST_F(CommandLine, AMuchDriftingBalanceIsAWarning) {
  write("swing.yaml", kSwing);
  const auto trusted = orthodyn("run swing.yaml --quiet");
  EXPECT_EQ(trusted.output.find("energy balance"), std::string::npos) << trusted.output;
  const auto doubted = orthodyn(
      "run swing.yaml --quiet --force --set damping=null --set 'integrator={type: backward_euler, step: 0.02}'");
  EXPECT_EQ(doubted.exit_code, 0) << doubted.output;
  EXPECT_NE(doubted.output.find("warning: the energy balance drifts by 0."), std::string::npos) << doubted.output;
  EXPECT_EQ(doubted.output.find("at the start and the end only"), std::string::npos) << doubted.output;
  EXPECT_GT(balance_drift(folder_), 0);
  EXPECT_NE(read_text(folder_ / "out/swing/run.json").find("\"warnings\""), std::string::npos);
}

TEST_F(CommandLine, ADriftBetweenTwoRowsSaysThatNothingBetweenThemWasLookedAt) {
  write("swing.yaml", kSwing);
  const std::string run =
      "run swing.yaml --quiet --force --set damping=null --set output.frames=1 --set 'integrator={type: "
      "backward_euler, step: 0.02}'";
  const auto two = orthodyn(run), all = orthodyn(run + " --set output.energy_times=steps");
  EXPECT_NE(two.output.find("at the start and the end only"), std::string::npos) << two.output;
  EXPECT_EQ(all.output.find("at the start and the end only"), std::string::npos) << all.output;
}

TEST_F(CommandLine, DriftOverAllStepsIsThatOfTheWholeRunNotOfItsFrames) {
  write("swing.yaml", kSwing);
  const auto drift = [&](const std::string& set) {
    EXPECT_EQ(orthodyn("run swing.yaml --quiet --force --set " + set).exit_code, 0);
    return balance_drift(folder_);
  };
  const double none = drift("output.frames=0"), all = drift("output.energy_times=steps");
  EXPECT_GT(none, drift("output.frames=3"));
  EXPECT_NEAR(none, all, 0.2 * none);
}

TEST_F(CommandLine, SaysWhichForceIsAtWork) {
  write("swing.yaml", kSwing);
  EXPECT_NE(orthodyn("check swing.yaml").output.find("exact gradient"), std::string::npos);
  EXPECT_NE(orthodyn("run swing.yaml --set elasticity.corotation=warped").output.find("WARPED"), std::string::npos);
  EXPECT_NE(read_text(folder_ / "out/swing/run.json").find("WARPED"), std::string::npos);
}

TEST_F(CommandLine, CtrlCEndsCleanlyWithTheFramesSoFar) {
  write("swing.yaml", kSwing);
  const auto result = shell("cd " + folder_.string() + " && " + program() +
                            " run swing.yaml --quiet --set time.end=1e3 --set integrator.h_max=1e-3 --set "
                            "output.interval=0.01 --set output.frames=null & pid=$!; for i in $(seq 100); do [ -e " +
                            folder_.string() +
                            "/out/swing/frames/frame_00003.vtu ] && break; sleep 0.1; done; kill -INT $pid; wait $pid");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_NE(result.output.find("interrupted at t ="), std::string::npos) << result.output;
  EXPECT_NE(read_text(folder_ / "out/swing/run.json").find("\"interrupted\""), std::string::npos);
  EXPECT_NE(read_text(folder_ / "out/swing/frames.pvd").find("frame_00003.vtu"), std::string::npos);
}

TEST_F(CommandLine, CheckPredictsAndWritesNothing) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("check swing.yaml");
  EXPECT_EQ(result.exit_code, 0);
  for (const char* word : {"unknowns", "non-zeros", "MiB", "mass", "eigenvalues of C", "critical step", "gravity"})
    EXPECT_NE(result.output.find(word), std::string::npos) << word;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CommandLine, ListNamesEverythingThatCanBeNamed) {
  const auto result = orthodyn("list");
  EXPECT_EQ(result.exit_code, 0);
  for (const char* name : {"orthotropic_stable", "cvode_bdf", "ida_bdf", "klu_full", "eigen_ldlt", "gmsh", "gravity",
                           "table", "stress_material", "nonlinear_coefficient"})
    EXPECT_NE(result.output.find(name), std::string::npos) << name;
  EXPECT_EQ(orthodyn("list materials").exit_code, 0);
}

TEST_F(CommandLine, HelpListsTheCommandsInTheOrderOfTheirUseAndHidesThoseOfProcesses) {
  const auto help = orthodyn("--help");
  EXPECT_EQ(help.exit_code, 0);
  std::size_t last = help.output.find("Subcommands:");
  for (const std::string name :
       {"run", "check", "modes", "compare", "sweep", "stability", "verify", "convert", "list", "schema", "init"}) {
    const auto at = help.output.find("\n  " + name + " ", last);
    EXPECT_NE(at, std::string::npos) << name;
    last = at;
    const auto own = orthodyn(name + " --help");
    EXPECT_EQ(own.exit_code, 0) << name;
    EXPECT_NE(own.output.find("\nExamples:\n  orthodyn " + name + " "), std::string::npos) << own.output;
  }
  for (const std::string name : {"measure", "evaluate", "assess"}) {
    EXPECT_EQ(help.output.find("\n  " + name + " "), std::string::npos) << name;
    EXPECT_EQ(orthodyn(name).exit_code, 2) << name;  // because the folder is missing
  }
}

TEST_F(CommandLine, OptionsThatDoNotGoTogetherAreRefused) {
  for (const std::string arguments :
       {"run a.yaml --force --resume", "run a.yaml --resume --estimate-error", "check a.yaml --out b",
        "sweep a.yaml --tasks 3", "sweep a.yaml --jobs 0", "sweep a.yaml --slurm=fast",
        "sweep a.yaml --collect --retry", "modes a.yaml -n 0"}) {
    const auto result = orthodyn(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_NE(result.output.find("Run with --help"), std::string::npos) << arguments << "\n" << result.output;
  }
}

}  // namespace
}  // namespace orthodyn::command_line_test
