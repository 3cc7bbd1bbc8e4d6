// `mpirun -n N orthodyn run`: results, restarts, messages, and failures.
#include <algorithm>

#include "tests/simulation/several_ranks.h"

namespace orthodyn::ranks_test {
namespace {

const std::string kShort = "time: {end: 0.4}\nintegrator: {type: generalized_alpha, step: 0.01, rtol: 1e-9}\n";

const std::string kEndless = "time: {end: 1000}\nintegrator: {type: generalized_alpha, step: 0.01, rtol: 1e-9}\n";

// Waits for a background run with the process id $pid.
std::string until_it_has_begun(const std::string& out) {
  return "for i in $(seq 200); do [ -e " + out + "/checkpoint.cbor ] && [ -s " + out +
         "/steps.csv ] && break; sleep 0.05; done; sleep 0.5; ";
}
std::string until_it_has_ended() {
  return "for i in $(seq 300); do kill -0 $pid 2>/dev/null || break; sleep 0.1; done; kill -0 $pid 2>/dev/null && { "
         "kill -KILL $pid; echo still there; }; wait $pid; }";
}

TEST_F(SeveralRanks, WriteWhatOneWrites) {
  write("beam.yaml", kBeam +
                         std::string("  reactions: true\n  history: {steps: true}\n"
                                     "  extremes: [von_mises.largest]\n"
                                     "events: [{name: up, quantity: tip.displacement.z, crosses: 0.001}]\n") +
                         kShort);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out one").exit_code, 0);
  for (const int ranks : {2, 3}) {
    const std::string out = "on_" + std::to_string(ranks);
    const auto result = orthodyn_on(ranks, "run beam.yaml --out " + out);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_EQ(count(result.output, "completed at t = 0.4 s"), 1) << result.output;
    EXPECT_EQ(read_text(folder_ / out / "frames.pvd"), read_text(folder_ / "one/frames.pvd"));
    EXPECT_TRUE(read_text(folder_ / out / "setup.vtu") == read_text(folder_ / "one/setup.vtu"));
    EXPECT_LE(difference(folder_ / out, folder_ / "one"), 1e-6);
    expect_alike(out, "one", 1e-6);
    expect_alike(out, "one", 1e-6, {"momentum.csv"});
    EXPECT_GE(read_text(folder_ / out / "events.csv").size(), 40u);
    EXPECT_EQ(count(read_text(folder_ / out / "events.csv"), "up"), count(read_text(folder_ / "one/events.csv"), "up"));
    const auto found = record(out).at("extremes"), expected = record("one").at("extremes");
    for (const auto& [quantity, extreme] : expected.items())
      EXPECT_NEAR(found.at(quantity).at("value"), extreme.at("value"), 1e-6 * extreme.at("value").get<double>());
    EXPECT_EQ(record(out).at("model").at("terms"), record("one").at("model").at("terms"));
    EXPECT_EQ(record(out).at("model").at("unknowns"), record("one").at("model").at("unknowns"));
    // Several ranks estimate the error from recovered stresses, one process by finer elements, which resolve more of
    // it.
    EXPECT_GT(record(out).at("errors").at("mesh"), 0.5 * record("one").at("errors").at("mesh").get<double>());
    EXPECT_LE(record(out).at("errors").at("mesh"), record("one").at("errors").at("mesh").get<double>());
  }
}

// A region may belong to one rank only, and a rank may hold only one region: checks of strengths and of regions at
// nodes are collective.
TEST_F(SeveralRanks, KnowWhichRegionsANodeIsOf) {
  const std::string body =
      "mesh: {type: box, size: [2, 1, 1], cells: [4, 2, 2], order: 1, parts: {up: {min: [1, 0, 0], max: [2, 1, 1]}}}\n"
      "materials:\n"
      "  a: {type: isotropic, density: 1000, young: 1e6, nu: 0.3, strength: {tension: 1e3, compression: 1e3, shear: "
      "1e3}}\n"
      "  b: {type: isotropic, density: 1000, young: 2e6, nu: 0.3}\n"
      "clamps: [{surface: x0}]\ngravity: [0, 0, -1]\ntime: {end: 0.1}\n"
      "integrator: {type: arkode_dirk, step: 0.05, rtol: 1e-9}\nelasticity: {kinematics: corotational}\n";
  const auto probed = [&](const std::string& regions, const std::string& at, const std::string& field) {
    write("s.yaml", body + "regions: " + regions +
                        "\noutput: {frames: 2, extremes: [von_mises.largest], probes: {p: {at: " + at + ", fields: [" +
                        field + "]}}}\n");
    const auto one = orthodyn("run s.yaml --quiet --force --out one");
    for (const int ranks : {2, 3}) {
      const auto several = orthodyn_on(ranks, "run s.yaml --quiet --force --out several");
      EXPECT_EQ(several.exit_code, one.exit_code) << several.output << one.output;
      if (one.exit_code == 0) expect_alike("several", "one", 1e-5);
      else EXPECT_EQ(count(several.output, one.output.substr(0, one.output.find('\n'))), 1) << several.output;
    }
    return one.exit_code;
  };
  const std::string all = "{all: {material: a}}", two = "{body: {material: b}, up: {material: a}}";
  for (const char* at : {"[0.5, 0, 0]", "[1, 1, 1]", "[2, 1, 1]"}) EXPECT_EQ(probed(all, at, "max_stress"), 0) << at;
  EXPECT_EQ(probed(two, "[2, 1, 1]", "max_stress"), 0);
  EXPECT_EQ(probed(two, "[2, 1, 1]", "up.nodal_stress_material"), 0);
  EXPECT_EQ(probed(two, "[0, 0, 0]", "max_stress"), 2);
  EXPECT_EQ(probed(two, "[0, 0, 0]", "up.nodal_stress_material"), 2);
}

TEST_F(SeveralRanks, GiveTheSameBitsTwice) {
  write("beam.yaml", kBeam + kShort);
  for (const std::string solver : {"auto", "petsc"}) {
    for (const char* out : {"first", "second"})
      ASSERT_EQ(orthodyn_on(3, std::string("run beam.yaml --quiet --force --set integrator.linear_solver=") + solver +
                                   " --out " + out)
                    .exit_code,
                0);
    for (const char* file : {"energy.csv", "frames/frame_00040.vtu"})
      EXPECT_EQ(read_text(folder_ / "first" / file), read_text(folder_ / "second" / file)) << solver << " " << file;
  }
}

TEST_F(SeveralRanks, GoOnWhereAnotherNumberOfThemStopped) {
  write("beam.yaml", kBeam + std::string("  interval: 0.02\n") + kShort);
  std::string scene = read_text(folder_ / "beam.yaml");
  scene.erase(scene.find("  frames: 40\n"), std::string("  frames: 40\n").size());
  write("beam.yaml", scene);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out one").exit_code, 0);
  const std::string run = "run beam.yaml --quiet --out parts --resume --set time.end=";
  ASSERT_EQ(orthodyn_on(2, run + "0.1").exit_code, 0);
  const auto third = orthodyn_on(3, run + "0.2");
  ASSERT_EQ(third.exit_code, 0) << third.output;
  ASSERT_EQ(orthodyn(run + "0.3").exit_code, 0);
  ASSERT_EQ(orthodyn_on(2, run + "0.4").exit_code, 0);
  EXPECT_EQ(record("parts").at("restarts").size(), 3u);
  EXPECT_LE(difference(folder_ / "parts", folder_ / "one"), 1e-3);  // the method starts anew three times
}

TEST_F(SeveralRanks, TellAFaultOfTheInputOnce) {
  write("beam.yaml", kBeam + kShort + "gravitas: 1\n");
  const auto result = orthodyn_on(3, "run beam.yaml --out bad");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_EQ(count(result.output, "gravitas"), 1) << result.output;
  EXPECT_FALSE(fs::exists(folder_ / "bad/scene.yaml"));
}

TEST_F(SeveralRanks, TellWhatIsWrongWithACommandLineOnce) {
  for (const auto& [line, words] : {std::pair{"walk beam.yaml", "unknown command 'walk'"},
                                    {"run beam.yaml --fast", "--fast"},
                                    {"check beam.yaml", "runs as one process only"},
                                    {"--plugin none.so run beam.yaml", "--plugin none.so: no such file"},
                                    {"run beam.yaml --ranks 2", "mpirun has already started 3 ranks"}}) {
    write("beam.yaml", kBeam + kShort);
    const auto result = orthodyn_on(3, line);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_EQ(count(result.output, words), 1) << result.output;
  }
}

TEST_F(SeveralRanks, AreStartedByAnOption) {
  write("beam.yaml", kBeam + kShort);
  const auto start = [&](const std::string& options) {
    return shell("cd " + folder_.string() + " && " + for_any_user() + program() + " run beam.yaml " + options);
  };
  const auto result = start("--ranks 2 --out by_option");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(record("by_option").at("ranks"), 2);
  ASSERT_EQ(orthodyn_on(2, "run beam.yaml --quiet --out by_mpirun").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "by_option/energy.csv"), read_text(folder_ / "by_mpirun/energy.csv"));
  const auto bad = start("--ranks 2 --out bad --set gravitas=1");
  EXPECT_EQ(bad.exit_code, 2) << bad.output;
  EXPECT_EQ(count(bad.output, "error: "), 1) << bad.output;
  const auto nothing = shell("cd " + folder_.string() + " && PATH=/nowhere " + program() + " run beam.yaml --ranks 2");
  EXPECT_EQ(nothing.exit_code, 2) << nothing.output;
  EXPECT_NE(nothing.output.find("mpirun is not on the PATH"), std::string::npos) << nothing.output;
  const auto resumed = start("--ranks 3 --quiet --out by_option --resume --set time.end=0.5");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
  EXPECT_EQ(record("by_option").at("restarts").size(), 1u);
}

TEST_F(SeveralRanks, AreRefusedByNameWhereTheyCannotCompute) {
  write("beam.yaml", kBeam + kShort);
  write("column.yaml", R"(
analysis: buckling
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1]}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-20, 0, 0]}]
)");
  const auto expect_refusal = [&](const std::string& arguments, const std::string& words) {
    const auto result = orthodyn_on(2, arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
  };
  expect_refusal("run beam.yaml --integrator exponential_rosenbrock",
                 "does not run on several ranks; those that do: arkode_dirk, arkode_erk, arkode_imex, auto");
  expect_refusal("run beam.yaml --integrator cvode_bdf --set integrator.linear_solver=klu_full",
                 "'klu_full' does not run on several ranks");
  expect_refusal("run beam.yaml --set mass=consistent", "mass: lumped");
  expect_refusal("run beam.yaml --estimate-error", "--estimate-error");
  expect_refusal("run beam.yaml --slurm", "--slurm");
  expect_refusal("run column.yaml", "buckling: this analysis runs in one process");
}

// As by Ctrl-C, which reaches mpirun: results are kept, and the run can be resumed.
class InterruptedRanks : public SeveralRanks, public testing::WithParamInterface<const char*> {};

TEST_P(InterruptedRanks, EndTogether) {
  write("beam.yaml", kBeam + kEndless);
  const std::string start = std::string(GetParam()) == "mpirun" ? mpirun(2) : for_any_user() + program() + " ";
  const std::string ranks = std::string(GetParam()) == "mpirun" ? "" : " --ranks 2";
  const auto result = shell("cd " + folder_.string() + " && { " + start + "run beam.yaml --out stopped" + ranks +
                            " & pid=$!; " + until_it_has_begun("stopped") +
                            "kill -INT $(pgrep -P $pid -x mpirun || echo $pid); " + until_it_has_ended());
  EXPECT_NE(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("still there"), std::string::npos) << result.output;
  const double reached = read_rows(folder_ / "stopped/steps.csv").back()[0];
  const auto resumed =
      orthodyn_on(2, "run beam.yaml --quiet --out stopped --resume --set time.end=" + std::to_string(reached + 0.05));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
}

INSTANTIATE_TEST_SUITE_P(Start, InterruptedRanks, testing::Values("mpirun", "option"),
                         [](const auto& how) { return std::string(how.param); });

// Only the first rank notices that frames cannot be written.
TEST_F(SeveralRanks, EndTogetherWhenOneFailsAlone) {
  write("beam.yaml", kBeam + kEndless);
  const auto result =
      shell("cd " + folder_.string() + " && { " + mpirun(2) + "run beam.yaml --quiet --out full --set " +
            "output.frames=100000 & pid=$!; " + until_it_has_begun("full") +
            "mv full/frames full/kept; touch full/frames; " + until_it_has_ended());
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_EQ(count(result.output, "error: "), 1) << result.output;
  for (const auto& frame : fs::directory_iterator(folder_ / "full/kept"))
    EXPECT_NE(read_text(frame.path()).find("</VTKFile>"), std::string::npos) << frame.path();
}

// Killing one rank ends all; the files are intact, and the run can be resumed.
TEST_F(SeveralRanks, EndTogetherWhenOneIsKilled) {
  write("beam.yaml", kBeam + kEndless);
  const auto result =
      shell("cd " + folder_.string() + " && { " + mpirun(2) + "run beam.yaml --quiet --out killed & pid=$!; " +
            until_it_has_begun("killed") +
            "kill -KILL $(pgrep -P $(pgrep -P $pid -x mpirun || echo $pid) | tail -n 1); " + until_it_has_ended());
  EXPECT_NE(result.exit_code, 0) << result.output;
  for (const auto& frame : fs::directory_iterator(folder_ / "killed/frames"))
    EXPECT_NE(read_text(frame.path()).find("</VTKFile>"), std::string::npos) << frame.path();
  EXPECT_EQ(result.output.find("still there"), std::string::npos) << result.output;
  const double reached = read_rows(folder_ / "killed/steps.csv").back()[0];
  const auto resumed =
      orthodyn_on(3, "run beam.yaml --quiet --out killed --resume --set time.end=" + std::to_string(reached + 0.05));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
}

}  // namespace
}  // namespace orthodyn::ranks_test
