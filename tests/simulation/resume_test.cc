// Runs that are killed, interrupted or extended, and go on from their checkpoint.
#include <fcntl.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <fstream>
#include <random>
#include <thread>

#include "tests/simulation/result_reader.h"

namespace orthodyn {
namespace {

using Json = nlohmann::json;

// A soft beam is shaken: it forgets, so that the cost of a restart is what one restart costs.
const char* const kBeam = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [6, 2, 2]}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
damping: {stiffness: 0.03}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 5], factor: {type: sine, frequency: 1.5}}]
checkpoint: {every: 0.02}
output:
  frames: 40
  momentum: true
  probes: {tip: {at: [1, 0.1, 0.1]}}
)";
constexpr double kRtol = 1e-4;
const char* const kBdf = "time: {end: 25}\nintegrator: {type: cvode_bdf, rtol: 1e-4}\n";
const char* const kFixedStep = "time: {end: 4}\nintegrator: {type: arkode_dirk, step: 0.02, rtol: 1e-8}\n";

// Root of the mean square difference over the body and the frames, the larger of displacement and velocity,
// relative to the scales of the integrator, which rtol is relative to as well.
double difference(const fs::path& a, const fs::path& b) {
  const auto decisions = Json::parse(read_text(a / "run.json")).at("integrator");
  const auto scale = [&](const char* key) { return std::stod(decisions.at(key).get<std::string>()); };
  const std::map<std::string, double> scales{{"displacement", scale("position_scale")},
                                             {"velocity", scale("velocity_scale")}};
  const auto times = read_times(a / "frames.pvd");
  EXPECT_EQ(times, read_times(b / "frames.pvd"));
  std::map<std::string, double> squares, count;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto digits = std::to_string(k);
    const auto name = "frames/frame_" + std::string(5 - digits.size(), '0') + digits + ".vtu";
    const auto one = read_fields(a / name), other = read_fields(b / name);
    EXPECT_EQ(one.size(), 2u) << name;
    for (const auto& [field, values] : one) {
      const auto& others = other.at(field);
      EXPECT_EQ(values.size(), others.size());
      for (std::size_t i = 0; i < std::min(values.size(), others.size()); ++i)
        squares[field] += std::pow((double{values[i]} - double{others[i]}) / scales.at(field), 2);
      count[field] += static_cast<double>(values.size());
    }
  }
  const auto rms = [&](const char* field) { return std::sqrt(squares[field] / count[field]); };
  return std::max(rms("displacement"), rms("velocity"));
}

// Rows at the same times, none lost and none doubled.
void expect_same_times(const fs::path& a, const fs::path& b) {
  for (const char* name : {"energy.csv", "probes.csv", "momentum.csv"}) {
    const auto one = read_rows(a / name), other = read_rows(b / name);
    ASSERT_EQ(one.size(), other.size()) << name;
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k][0], other[k][0]) << name;
      EXPECT_EQ(one[k].size(), other[k].size()) << name;
    }
  }
}

class Resume : public InFolder {
 protected:
  Json record(const std::string& name) const { return Json::parse(read_text(folder_ / name / "run.json")); }

  // Starts a run, kills it after some milliseconds; true if it completed before.
  bool run_and_kill(const std::string& arguments, double milliseconds) const {
    const pid_t pid = fork();
    if (pid == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(9);
      const int log = open("log.txt", O_WRONLY | O_CREAT | O_APPEND, 0666);
      dup2(log, 1);
      dup2(log, 2);
      execl("/bin/sh", "sh", "-c", ("exec " ORTHODYN_EXECUTABLE " " + arguments).c_str(), nullptr);
      _exit(9);
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
    int status = 0;
    while (std::chrono::steady_clock::now() < end) {
      if (waitpid(pid, &status, WNOHANG) == pid) {
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status << read_text(folder_ / "log.txt");
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    return false;
  }

  // Kills at random moments until the run is through. The number of kills.
  int run_with_kills(const std::string& scene, const std::string& out, double longest_milliseconds, std::mt19937& random) {
    std::uniform_real_distribution<double> moment(1, longest_milliseconds);
    for (int kills = 0; kills < 200; ++kills)
      if (run_and_kill("run " + scene + " --quiet --resume --out " + out, moment(random) * (1 + kills / 20))) return kills;
    ADD_FAILURE() << "does not come to an end:\n" << read_text(folder_ / "log.txt");
    return 0;
  }
};

int repetitions() {
  const char* given = std::getenv("ORTHODYN_KILL_REPETITIONS");
  return given ? std::atoi(given) : 2;
}

TEST_F(Resume, KilledAtRandomMomentsItEndsWithTheSameFrames) {
  struct Method {
    const char* name;
    const char* integrator;
    double tolerance;
  };
  // A restart of a multistep method costs some tolerances, as the whole run does. A fixed step repeats the same steps: what
  // remains is where Newton stops.
  for (const auto& [name, integrator, tolerance] :
       {Method{"bdf", kBdf, 10 * kRtol}, {"fixed", kFixedStep, 1e-6}}) {
    const std::string scene = write(std::string(name) + ".yaml", kBeam + std::string(integrator)).string();
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(orthodyn("run " + scene + " --quiet --out whole_" + name).exit_code, 0);
    const double milliseconds =
        1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::mt19937 random(7);
    int all_kills = 0;
    for (int r = 0; r < repetitions(); ++r) {
      const std::string out = name + std::to_string(r);
      const int kills = run_with_kills(scene, out, 0.9 * milliseconds, random);
      all_kills += kills;
      const double worst = difference(folder_ / out, folder_ / ("whole_" + std::string(name)));
      const auto json = record(out);
      EXPECT_LE(worst, tolerance) << out;
      expect_same_times(folder_ / out, folder_ / ("whole_" + std::string(name)));
      EXPECT_EQ(json.at("status"), "completed");
      for (const auto& entry : fs::recursive_directory_iterator(folder_ / out))
        EXPECT_NE(entry.path().extension(), ".part") << entry.path();
      if (std::getenv("ORTHODYN_KILL_REPETITIONS"))
        std::printf("%s: %d kills, %zu restarts, largest difference %.2e\n", out.c_str(), kills,
                    json.value("restarts", Json::array()).size(), worst);
    }
    EXPECT_GT(all_kills, 0);
  }
}

// A run that stopped in the middle for max_steps.
class Stopped : public Resume {
 protected:
  Stopped() {
    write("beam.yaml", kBeam + std::string(kBdf));
    const auto result = orthodyn("run beam.yaml --quiet --set integrator.max_steps=60");
    EXPECT_EQ(result.exit_code, 3) << result.output;
    EXPECT_NE(result.output.find("orthodyn run out/beam --resume"), std::string::npos) << result.output;
  }

  // Every file with its content.
  std::map<std::string, std::string> content() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      if (entry.is_regular_file()) files[entry.path().string()] = read_text(entry.path());
    return files;
  }

  void expect_refused(const std::string& arguments, const std::string& words) const {
    const auto before = content();
    const auto result = orthodyn("run " + arguments + " --resume");
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.output;
    EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
    EXPECT_EQ(content(), before) << arguments;
  }

  fs::path checkpoint_ = folder_ / "out/beam/checkpoint.cbor";
};

TEST_F(Stopped, ARunThatFailedForMaxStepsGoesOnWithMore) {
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole").exit_code, 0);
  EXPECT_LT(difference(folder_ / "out/beam", folder_ / "whole"), 10 * kRtol);
  expect_same_times(folder_ / "out/beam", folder_ / "whole");
}

TEST_F(Stopped, TheRecordTellsOfTheRestartAndSumsUp) {
  ASSERT_EQ(orthodyn("run out/beam --quiet --resume --set integrator.max_steps=1000").exit_code, 0);
  const auto json = record("out/beam");
  ASSERT_EQ(json.at("restarts").size(), 1u);
  EXPECT_EQ(json["restarts"][0]["after"], "failed");
  EXPECT_EQ(json["restarts"][0]["changed"], Json::array({"integrator.max_steps"}));
  EXPECT_GT(json["restarts"][0]["time"], 0);
  EXPECT_EQ(json.at("statistics").at("steps"), read_rows(folder_ / "out/beam/steps.csv").size());
}

TEST_F(Stopped, TheBalanceOfEnergyGoesOnWhereItWas) {
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole").exit_code, 0);
  const auto dissipated = [&](const char* name) { return record(name).at("energy").at("dissipated").get<double>(); };
  EXPECT_GT(dissipated("whole"), 0);
  EXPECT_NEAR(dissipated("out/beam"), dissipated("whole"), 1e-2 * dissipated("whole"));
  EXPECT_LT(record("out/beam").at("energy").at("balance_drift"), 10 * record("whole").at("energy").at("balance_drift").get<double>());
}

TEST_F(Stopped, AnotherSceneIsRefusedByTheKeysThatDiffer) {
  expect_refused("beam.yaml --set loads.0.force.2=7 --set integrator.rtol=1e-5", "loads.0.force.2, integrator.rtol differ");
  expect_refused("beam.yaml --set output.frames=10", "output.frames");
  expect_refused("beam.yaml --set damping=null", "damping");
  expect_refused("beam.yaml --integrator ida_bdf", "integrator.type");
  expect_refused("beam.yaml --set time.end=0.01", "before the checkpoint");
}

TEST_F(Stopped, ADamagedCheckpointIsRefusedAndNothingDestroyed) {
  const std::string whole = read_text(checkpoint_);
  std::mt19937 random(5);
  const auto put = [&](const std::string& text) { std::ofstream(checkpoint_, std::ios::binary) << text; };
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, std::size_t{41}, std::size_t{60}, whole.size() / 2, whole.size() - 1}) {
    put(whole.substr(0, length));
    expect_refused("beam.yaml", "checkpoint.cbor: ");
  }
  for (int k = 0; k < 25; ++k) {
    std::string damaged = whole;
    damaged[random() % (k < 10 ? 42 : damaged.size())] ^= static_cast<char>(1 << random() % 8);
    put(damaged);
    expect_refused("beam.yaml", "checkpoint.cbor: ");
  }
  put(std::string(100000, '\x81'));  // arrays in arrays
  expect_refused("beam.yaml", "is no checkpoint");
}

TEST_F(Stopped, ACheckpointOfAnotherVersionIsNamed) {
  std::string text = read_text(checkpoint_);
  text.replace(text.find(" 002 "), 5, " 001 ");
  std::ofstream(checkpoint_, std::ios::binary) << text;
  expect_refused("beam.yaml", "version 1 of the format");
}

TEST_F(Stopped, ALostFrameOrTableIsNamedAndNothingElseTouched) {
  fs::resize_file(folder_ / "out/beam/probes.csv", 40);
  expect_refused("beam.yaml", "probes.csv: has 40 bytes");
  fs::remove(folder_ / "out/beam/frames/frame_00001.vtu");
  expect_refused("beam.yaml", "frame_00001.vtu: is missing");
}

TEST_F(Stopped, WithoutItsCheckpointItIsRefused) {
  fs::remove(checkpoint_);
  expect_refused("beam.yaml", "without a checkpoint");
}

TEST_F(Resume, ACompletedRunIsLeftAloneAndCanBeExtended) {
  write("beam.yaml", kBeam + std::string(kFixedStep));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --set time.end=0.6 --set output.frames=8 --resume").exit_code, 0);
  const auto frames = read_text(folder_ / "out/beam/frames.pvd");
  const auto again = orthodyn("run out/beam --resume");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.output.find("is complete"), std::string::npos) << again.output;
  EXPECT_EQ(read_text(folder_ / "out/beam/frames.pvd"), frames);

  const auto longer = orthodyn("run out/beam --resume --set time.end=1.2");
  ASSERT_EQ(longer.exit_code, 0) << longer.output;
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --set time.end=1.2 --set output.frames=16 --out whole").exit_code, 0);
  const auto times = read_times(folder_ / "out/beam/frames.pvd"), expected = read_times(folder_ / "whole/frames.pvd");
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], expected[k], 1e-12);
  EXPECT_EQ(record("out/beam")["restarts"][0]["changed"], Json::array({"time.end"}));
}

TEST_F(Resume, AnInterruptedRunGoesOnThoughItsSceneAsksForNoCheckpoints) {
  write("swing.yaml", kSwing);
  const std::string run = "run swing.yaml --quiet --set integrator.h_max=1e-5 --set time.end=";
  const auto stopped = shell("cd " + folder_.string() + " && { " ORTHODYN_EXECUTABLE " " + run +
                             "1e3 & pid=$!; for i in $(seq 200); do [ -s out/swing/steps.csv ] && break; sleep 0.05; "
                             "done; kill -TERM $pid; wait $pid; }");
  ASSERT_EQ(stopped.exit_code, 130) << stopped.output;
  const double reached = record("out/swing").at("time_reached");
  const auto result = orthodyn(run + std::to_string(reached + 0.001) + " --resume");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(record("out/swing")["restarts"][0]["after"], "interrupted");
  EXPECT_EQ(record("out/swing")["restarts"][0]["time"], reached);
}

TEST_F(Resume, ARunKilledAfterItsLastStepGetsItsRecord) {
  write("beam.yaml", kBeam + std::string(kFixedStep));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --set time.end=0.1").exit_code, 0);
  const auto frames = read_text(folder_ / "out/beam/frames.pvd");
  write("out/beam/run.json", R"({"status": "running"})");
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume --set time.end=0.1").exit_code, 0);
  EXPECT_EQ(record("out/beam").at("status"), "completed");
  EXPECT_EQ(record("out/beam").at("statistics").at("steps"), 5);
  EXPECT_EQ(read_text(folder_ / "out/beam/frames.pvd"), frames);
}

TEST_F(Resume, ARunThatFilledTheDiskGoesOnWhenThereIsRoom) {
  write("beam.yaml", kBeam + std::string(kFixedStep));
  // No file may grow past 8 kB: steps.csv does, in the middle of the run.
  const auto full = shell("cd " + folder_.string() + " && trap '' XFSZ; ulimit -f 16; " ORTHODYN_EXECUTABLE
                          " run beam.yaml --quiet --set output.fields=[region]");
  ASSERT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("cannot write"), std::string::npos) << full.output;
  const auto result = orthodyn("run beam.yaml --quiet --resume --set output.fields=[region]");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(read_rows(folder_ / "out/beam/steps.csv").size(), 200u);
  EXPECT_EQ(read_times(folder_ / "out/beam/frames.pvd").size(), 41u);
}

TEST_F(Resume, TheErrorIsEstimatedOnRequestAndRecorded) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml --estimate-error");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("integrator.rtol=0.0001"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("the integration puts displacements off by about"), std::string::npos) << result.output;
  const auto error = record("out/swing").at("estimated_error");
  EXPECT_EQ(error.at("samples"), 6);
  EXPECT_GT(error.at("displacement").at("largest"), 0);
  EXPECT_LT(error.at("displacement").at("largest"), 0.1);
}

TEST_F(Resume, AnEstimateThatCannotBeMadeIsRefusedBeforeTheEarlierResultIsTouched) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  const auto result = orthodyn("run swing.yaml --quiet --force --estimate-error --set output.frames=0");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_TRUE(fs::exists(folder_ / "out/swing/frames/frame_00005.vtu"));
}

TEST_F(Resume, AMeshFileThatHasChangedIsRefused) {
  const auto mesh = [&](const char* height) {
    write("tet.msh", std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 ") +
                         height + "\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
  };
  mesh("1");
  write("tet.yaml", "mesh: {type: gmsh, file: tet.msh}\nmaterials: {m: {type: isotropic, density: 1, young: 1e3, nu: 0.3}}\n"
                    "initial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\ncheckpoint: {every: 1}\n");
  const auto first = orthodyn("run tet.yaml --quiet");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  mesh("1.1");
  const auto result = orthodyn("run tet.yaml --quiet --resume --set time.end=0.2");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("tet.msh: is not the file"), std::string::npos) << result.output;
}

// Two tetrahedra; `regions` are the attributes of the two.
class TetgenMesh : public Resume {
 protected:
  TetgenMesh() {
    write("two.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n");
    write_elements("1", "2");
    write("two.yaml",
          "mesh: {type: file, file: two.node}\nmaterials: {m: {type: isotropic, density: 1, young: 1e3, nu: 0.3}}\n"
          "initial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\ncheckpoint: {every: 1}\n");
  }
  void write_elements(const std::string& first, const std::string& second) const {
    write("two.ele", "2 4 1\n1 1 2 3 4 " + first + "\n2 1 3 2 5 " + second + "\n");
  }
};

TEST_F(TetgenMesh, ElementsThatChangedTheirRegionsAreRefused) {
  const auto first = orthodyn("run two.yaml --quiet");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  write_elements("2", "1");
  const auto result = orthodyn("run two.yaml --quiet --resume --set time.end=0.2");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("the mesh is not the one"), std::string::npos) << result.output;
}

TEST_F(TetgenMesh, AFileOfTheInputThatHasChangedIsRefusedByItsName) {
  const auto axes = [&](const char* first) {
    write("axes.csv", "a1x,a1y,a1z,a2x,a2y,a2z\n" + std::string(first) + "\n1,0,0,0,1,0\n");
  };
  axes("1,0,0,0,1,0");
  write("grain.yaml",
        "mesh: {type: file, file: two.node}\nmaterials: {m: {type: orthotropic_stable, density: 1, young: [3e3, 2e3, "
        "1e3], nu: 0.3}}\nregions: {all: {material: m, axes: {type: file, file: axes.csv}}}\n"
        "initial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\ncheckpoint: {every: 1}\n");
  const auto first = orthodyn("run grain.yaml --quiet");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  const auto same = orthodyn("run out/grain --quiet --resume --set time.end=0.2");  // named from another folder
  ASSERT_EQ(same.exit_code, 0) << same.output;
  axes("0,1,0,1,0,0");
  const auto result = orthodyn("run grain.yaml --quiet --resume --set time.end=0.3");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("axes.csv"), std::string::npos) << result.output;
}

TEST_F(Resume, OneRunAtATimeWorksInAFolder) {
  write("swing.yaml", kSwing + std::string("checkpoint: {every: 0.01}\n"));
  const std::string run = ORTHODYN_EXECUTABLE " run swing.yaml --quiet --set time.end=1e3 --set integrator.h_max=1e-5 ";
  const auto tried = shell("cd " + folder_.string() + " && { " + run +
                           "& pid=$!; for i in $(seq 200); do [ -s out/swing/steps.csv ] && break; sleep 0.05; done; "
                           "for how in --resume --force ''; do timeout 5 " + run +
                           "$how; echo \"code $?\"; done; kill -TERM $pid; wait $pid; }");
  EXPECT_EQ(tried.exit_code, 130);
  std::size_t refused = 0;
  for (std::size_t at = 0; (at = tried.output.find("another run is at work there", at)) != std::string::npos; ++at) ++refused;
  EXPECT_EQ(refused, 3u) << tried.output;
  EXPECT_EQ(tried.output.find("code 0"), std::string::npos) << tried.output;
}

TEST_F(Resume, AFolderWithNothingButALockIsEmpty) {
  write("swing.yaml", kSwing);
  fs::create_directories(folder_ / "out/swing");
  write("out/swing/.orthodyn-run", "");
  const auto result = orthodyn("run swing.yaml --quiet");
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST_F(Stopped, OnlyFramesOfTheRunAreRemovedWhenItGoesOn) {
  const auto frames = folder_ / "out/beam/frames";
  const std::vector<std::string> others{"frame_99999.png", "frame_99999.vtu.bak", "frame_99999.vtu.part.txt", "frame_7.vtu"};
  const std::vector<std::string> ours{"frame_99999.vtu", "frame_99998.vtu.part", "frame_00000.vtu.part"};
  for (const auto& name : others) std::ofstream(frames / name) << "x";
  for (const auto& name : ours) std::ofstream(frames / name) << "x";
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  for (const auto& name : others) EXPECT_TRUE(fs::exists(frames / name)) << name;
  for (const auto& name : ours) EXPECT_FALSE(fs::exists(frames / name)) << name;
}

TEST_F(Resume, TimesWithAUnitAreUnderstoodWhereARunIsComplete) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --set 'time.end=500 ms'").exit_code, 0);
  const auto result = orthodyn("run swing.yaml --resume --set 'time.end=500 ms'");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("complete at t = 0.5 s"), std::string::npos) << result.output;
}

TEST_F(Resume, TheSameValueInAnotherUnitIsNoChange) {
  write("swing.yaml", kSwing + std::string("checkpoint: {every: 60}\n"));
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --set 'materials.soft.young=0.1 MPa'").exit_code, 0);
  const auto result = orthodyn("run swing.yaml --quiet --resume --set time.end=0.6");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const auto other = orthodyn("run swing.yaml --quiet --resume --set time.end=0.7 --set 'materials.soft.young=0.2 MPa'");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.output.find("materials.soft.young differs"), std::string::npos) << other.output;
}

TEST_F(Resume, ItDoesNotGoTogetherWithForce) {
  write("beam.yaml", kBeam + std::string(kBdf));
  EXPECT_EQ(orthodyn("run beam.yaml --resume --force").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace orthodyn
