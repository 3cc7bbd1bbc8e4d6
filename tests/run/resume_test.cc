// Runs that are killed, interrupted or extended, and go on from their checkpoint.
#include <fcntl.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/run/result_reader.h"

namespace orthodyn {
namespace {

using Json = nlohmann::json;

const char* const kBeam = R"(# A soft beam swings for several periods.
mesh: {type: box, size: [1, 0.2, 0.2], cells: [8, 3, 3]}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
damping: {stiffness: 0.03}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
time: {end: 3}
checkpoint: {every: 0.02}
output:
  frames: 40
  momentum: true
  probes: {tip: {at: [1, 0.1, 0.1]}}
)";
const char* const kBdf = "integrator: {type: cvode_bdf, rtol: 1e-5}\n";
const char* const kFixedStep = "integrator: {type: arkode_dirk, step: 2e-3, rtol: 1e-8}\n";

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
  int run_with_kills(const std::string& scene, const std::string& out, double mean_milliseconds, std::mt19937& random) {
    std::uniform_real_distribution<double> moment(1, 2 * mean_milliseconds);
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
  // A restart of a multistep method costs about one tolerance. A fixed step repeats the same steps: what
  // remains is where Newton stops.
  for (const auto& [name, integrator, tolerance] :
       {Method{"bdf", kBdf, 10 * 1e-5}, {"fixed", kFixedStep, 1e-7}}) {
    const std::string scene = write(std::string(name) + ".yaml", kBeam + std::string(integrator)).string();
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(orthodyn("run " + scene + " --quiet --out whole_" + name).exit_code, 0);
    const double milliseconds =
        1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::mt19937 random(7);
    int all_kills = 0;
    for (int r = 0; r < repetitions(); ++r) {
      const std::string out = name + std::to_string(r);
      const int kills = run_with_kills(scene, out, milliseconds / 4, random);
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

}  // namespace
}  // namespace orthodyn
