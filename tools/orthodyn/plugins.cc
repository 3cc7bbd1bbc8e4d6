#include "tools/orthodyn/plugins.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "lib/core/errors.h"
#include "lib/config/registry.h"

namespace orthodyn {

namespace {

constexpr const char* kVariable = "ORTHODYN_PLUGINS";

std::vector<std::string> from_environment() {
  std::vector<std::string> files;
  const char* listed = std::getenv(kVariable);
  std::istringstream in(listed ? listed : "");
  for (std::string file; std::getline(in, file, ':');)
    if (!file.empty()) files.push_back(file);
  return files;
}

void load(const std::string& file) {
  if (!dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL))
    throw ConfigError("plugin " + file + " cannot be loaded: " + dlerror());
}

}  // namespace

void load_plugins(const std::vector<std::string>& files) {
  auto all = from_environment();
  for (const auto& file : files) {
    if (!std::filesystem::exists(file)) throw ConfigError("--plugin " + file + ": no such file");
    all.push_back(std::filesystem::absolute(file).string());
  }
  for (const auto& file : all) {
    load(file);
    if (!registry_conflicts().empty())
      throw ConfigError("plugin " + file + ": the name '" + registry_conflicts().front() +
                        "' is taken; choose another");
  }
  if (!all.empty()) setenv(kVariable, join(all, ":").c_str(), 1);
}

}  // namespace orthodyn
