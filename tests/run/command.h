// Runs the command line as a user would: exit code, what it said, and what it left behind.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace orthodyn {

namespace fs = std::filesystem;

struct CommandResult {
  int exit_code;
  std::string output;  // both streams
};

inline CommandResult shell(const std::string& command) {
  std::FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
  std::string output;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output};
}

inline std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// A folder of its own for each test, gone afterwards.
class InFolder : public testing::Test {
 protected:
  InFolder()
      : folder_(fs::temp_directory_path() / ("orthodyn_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~InFolder() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  CommandResult orthodyn(const std::string& arguments) const {
    return shell("cd " + folder_.string() + " && " ORTHODYN_EXECUTABLE " " + arguments);
  }

  fs::path folder_;
};

inline const char* const kSwing = R"(# A soft bar swings.
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1]}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
damping: {stiffness: 0.01}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
time: {end: 0.5}
integrator: {type: cvode_bdf, rtol: 1e-3}
output:
  frames: 5
  probes: {tip: {at: [1, 0.1, 0.1]}}
)";

}  // namespace orthodyn
