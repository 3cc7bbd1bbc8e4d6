#include "tools/orthodyn/installed_paths.h"

#include <cstdlib>

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

fs::path shared(const char* installed, const char* in_source) {
  const fs::path found = fs::read_symlink("/proc/self/exe").parent_path() / ORTHODYN_SHARE_FROM_BIN / installed;
  return fs::exists(found) ? found.lexically_normal() : fs::path(ORTHODYN_SOURCE) / in_source;
}

}  // namespace

fs::path draw_tool() { return shared("draw/draw", "tools/draw/draw"); }

std::vector<std::string> draw_command() {
  const char* python = std::getenv("ORTHODYN_DRAW_PYTHON");
  if (!python || !*python) return {draw_tool().string()};
  return {python, draw_tool().string()};
}

fs::path schema_file(const std::string& kind) {
  return shared(("schema/" + kind + ".json").c_str(), ("configs/schema/" + kind + ".json").c_str());
}

}  // namespace orthodyn
