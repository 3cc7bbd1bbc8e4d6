// Runs the program in a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace orthodyn {

namespace fs = std::filesystem;

struct CommandResult {
  int exit_code;
  std::string output;  // both streams
};

CommandResult shell(const std::string& command);

// Path of a built program: in the folder ORTHODYN_PROGRAMS, or in the build of the tests.
std::string program(const std::string& name = "orthodyn");

std::string read_text(const fs::path& path);

// A temporary folder for each test.
class InFolder : public testing::Test {
 protected:
  InFolder();
  ~InFolder() override;

  fs::path write(const std::string& name, const std::string& text) const;
  CommandResult orthodyn(const std::string& arguments) const;

  fs::path folder_;
};

inline const char* const kSwing = R"(# A soft bar swings.
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
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
