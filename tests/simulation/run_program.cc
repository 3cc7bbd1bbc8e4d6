#include "tests/simulation/run_program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace orthodyn {

CommandResult shell(const std::string& command) {
  std::FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
  std::string output;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output};
}

std::string program(const std::string& name) {
  const char* folder = std::getenv("ORTHODYN_PROGRAMS");
  return fs::path(folder != nullptr ? folder : ORTHODYN_PROGRAMS) / name;
}

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

InFolder::InFolder()
    : folder_(fs::temp_directory_path() / ("orthodyn_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name())) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
}

InFolder::~InFolder() { fs::remove_all(folder_); }

fs::path InFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name) << text;
  return folder_ / name;
}

CommandResult InFolder::orthodyn(const std::string& arguments) const {
  return shell("cd " + folder_.string() + " && " + program() + " " + arguments);
}

}  // namespace orthodyn
