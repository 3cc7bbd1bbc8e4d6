// Runs that are killed, interrupted or stopped by a full disk, and go on from their checkpoint.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "lib/simulation/output/json.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::killed_run_test {
namespace {

// Kills runs at moments of its choice.
class Killed : public Resume {
 protected:
  // Starts a run, kills it after some milliseconds; true if it completed before.
  bool run_and_kill(const std::string& arguments, double milliseconds) const {
    const pid_t pid = fork();
    if (pid == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(9);
      const int log = open("log.txt", O_WRONLY | O_CREAT | O_APPEND, 0666);
      dup2(log, 1);
      dup2(log, 2);
      execl("/bin/sh", "sh", "-c", ("exec " + program() + " " + arguments).c_str(), nullptr);
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
  int run_with_kills(const std::string& scene, const std::string& out, double longest_milliseconds,
                     std::mt19937& random) {
    std::uniform_real_distribution<double> moment(1, longest_milliseconds);
    for (int kills = 0; kills < 200; ++kills)
      if (run_and_kill("run " + scene + " --quiet --resume --out " + out, moment(random) * (1 + kills / 20)))
        return kills;
    ADD_FAILURE() << "does not come to an end:\n" << read_text(folder_ / "log.txt");
    return 0;
  }
};

int repetitions() {
  const char* given = std::getenv("ORTHODYN_KILL_REPETITIONS");
  return given ? std::atoi(given) : 2;
}

TEST_F(Killed, KilledAtRandomMomentsItEndsWithTheSameFrames) {
  struct Method {
    const char* name;
    const char* integrator;
    double tolerance;
  };
  // A restart of a multistep method costs some tolerances, as the whole run does. A fixed step repeats the same steps:
  // what remains is where Newton stops.
  for (const auto& [name, integrator, tolerance] : {Method{"bdf", kBdf, 10 * kRtol}, {"fixed", kFixedStep, 1e-6}}) {
    const std::string history = "  history: {interval: 0.013}\n";  // of the section that kBeam ends with
    const std::string scene = write(std::string(name) + ".yaml", kBeam + history + integrator).string();
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(orthodyn("run " + scene + " --quiet --out whole_" + name).exit_code, 0);
    const double milliseconds = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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

TEST_F(Resume, AnInterruptedRunGoesOnThoughItsSceneAsksForNoCheckpoints) {
  write("swing.yaml", kSwing);
  const std::string run = "run swing.yaml --quiet --set integrator.h_max=1e-5 --set time.end=";
  const auto stopped = shell("cd " + folder_.string() + " && { " + program() + " " + run +
                             "1e3 & pid=$!; for i in $(seq 200); do [ -s out/swing/steps.csv ] && break; sleep 0.05; "
                             "done; kill -TERM $pid; wait $pid; }");
  ASSERT_EQ(stopped.exit_code, 130) << stopped.output;
  const double reached = record("out/swing").at("time_reached");
  const auto result = orthodyn(run + std::to_string(reached + 0.001) + " --resume");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(record("out/swing")["restarts"][0]["after"], "interrupted");
  EXPECT_EQ(record("out/swing")["restarts"][0]["time"], reached);
}

// A factorisation that would take minutes.
TEST_F(Resume, ATermSignalEndsALongFactorisationToo) {
  write("block.yaml", R"(
mesh: {type: box, size: [1, 1, 1], cells: [22, 22, 22], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
time: {end: 0.5}
integrator: {type: arkode_dirk, step: 0.01, position_scale: 0.1, velocity_scale: 0.1, linear_solver: eigen_ldlt}
)");
  const auto stopped = shell("cd " + folder_.string() + " && { " + program() +
                             " run block.yaml --quiet & pid=$!; for i in $(seq 600); do [ -e out/block/steps.csv ] && "
                             "break; sleep 0.05; done; sleep 1; kill -TERM $pid; for i in $(seq 60); do kill -0 $pid "
                             "2>/dev/null || break; sleep 0.5; done; kill -KILL $pid 2>/dev/null; wait $pid; }");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_NE(stopped.output.find("in the middle of a computation"), std::string::npos) << stopped.output;
  EXPECT_EQ(record("out/block").at("status"), "running");
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
  const auto full = shell("cd " + folder_.string() + " && trap '' XFSZ; ulimit -f 16; " + program() +
                          " run beam.yaml --quiet --set output.fields=[region]");
  ASSERT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("cannot write"), std::string::npos) << full.output;
  const auto result = orthodyn("run beam.yaml --quiet --resume --set output.fields=[region]");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(read_rows(folder_ / "out/beam/steps.csv").size(), 200u);
  EXPECT_EQ(read_times(folder_ / "out/beam/frames.pvd").size(), 41u);
}

// A disk of 1 MB without a byte left, which only root can have.
TEST_F(Resume, ARunThatFilledAWholeDiskGoesOnWhenThereIsRoom) {
  const std::string disk = (folder_ / "disk").string();
  fs::create_directories(disk);
  if (shell("mount -t tmpfs -o size=1m tmpfs " + disk + " 2>&1").exit_code != 0) GTEST_SKIP() << "no mount";
  write("swing.yaml", kSwing);
  const std::string run = "run swing.yaml --quiet --out disk/swing --set integrator.h_max=1e-5 --set output.frames=400";
  const auto full = orthodyn(run);
  const auto enlarged = shell("mount -o remount,size=64m " + disk);
  const auto result = orthodyn(run + " --resume");
  const bool completed = result.exit_code == 0 && record("disk/swing").at("status") == "completed";
  shell("umount " + disk);
  ASSERT_EQ(enlarged.exit_code, 0);
  EXPECT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("No space left"), std::string::npos) << full.output;
  EXPECT_EQ(full.output.find("no checkpoint"), std::string::npos) << full.output;
  EXPECT_TRUE(completed) << result.output;
}

TEST_F(Resume, ARunThatFilledTheDiskGoesOnThoughItsSceneAsksForNoCheckpoints) {
  write("swing.yaml", kSwing);
  // No file may grow past 24 kB: steps.csv does, and run.json has its room.
  const std::string run = "run swing.yaml --quiet --set integrator.h_max=2e-4 --set output.fields=[region]";
  const auto full = shell("cd " + folder_.string() + " && trap '' XFSZ; ulimit -f 48; " + program() + " " + run);
  ASSERT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("cannot write"), std::string::npos) << full.output;
  EXPECT_NE(full.output.find("--resume"), std::string::npos) << full.output;
  const auto result = orthodyn(run + " --resume");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  ASSERT_EQ(record("out/swing").at("status"), "completed");
  EXPECT_EQ(record("out/swing").at("restarts").size(), 1u);
  EXPECT_EQ(read_times(folder_ / "out/swing/frames.pvd").size(), 6u);
  EXPECT_EQ(record("out/swing").at("statistics").at("steps"), read_rows(folder_ / "out/swing/steps.csv").size());
}

}  // namespace
}  // namespace orthodyn::killed_run_test
