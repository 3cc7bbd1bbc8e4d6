#include "tools/orthodyn/plugins.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "lib/config/registry.h"
#include "lib/core/errors.h"
#include "lib/core/file_kind.h"
#include "lib/core/spelling.h"
#include "lib/core/versions.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/linear/solver.h"
#include "lib/material/material.h"
#include "lib/material_axes/axes_source.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/mesh/mesh_source.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

namespace {

std::vector<std::string> from_environment() {
  std::vector<std::string> files;
  const char* listed = std::getenv(kPluginsVariable);
  std::istringstream in(listed ? listed : "");
  for (std::string file; std::getline(in, file, ':');)
    if (!file.empty()) files.push_back(file);
  return files;
}

// Number of registered entries.
std::size_t num_registered() {
  return Registry<Material>::entries().size() + Registry<TermChoice>::entries().size() +
         Registry<IntegratorChoice>::entries().size() + Registry<MeshSource>::entries().size() +
         Registry<AxesSource>::entries().size() + Registry<TimeFunction>::entries().size() + mesh_formats().size() +
         solver_registry().size();
}

// Throws ConfigError if the file cannot be loaded, a name is taken, or nothing is registered.
void load(const std::string& file) {
  const std::size_t before = num_registered();
  if (!dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL))
    throw ConfigError(
        fmt::format("plugin {} cannot be loaded: {}. Is it a shared library, built against this orthodyn ({}) with the "
                    "same options? See docs/extend.md",
                    file, dlerror(), orthodyn_version()));
  if (!registry_conflicts().empty())
    throw ConfigError("plugin " + file + ": the name '" + registry_conflicts().front() +
                      "' is already taken; choose another");
  if (num_registered() == before)
    throw ConfigError(fmt::format(
        "plugin {} adds nothing: no material, term, integrator, mesh, axes, factor or solver registers itself when it "
        "is loaded. Is it the intended file, built against this orthodyn ({})? See docs/extend.md",
        file, orthodyn_version()));
}

}  // namespace

void load_plugins(const std::vector<std::string>& files) {
  auto all = from_environment();
  for (const auto& file : files) {
    if (!is_there(file)) throw ConfigError("--plugin " + file + ": no such file");
    const std::string path = std::filesystem::absolute(file).lexically_normal().string();
    if (std::find(all.begin(), all.end(), path) == all.end()) all.push_back(path);
  }
  for (const auto& file : all) load(file);
  if (!all.empty()) setenv(kPluginsVariable, join(all, ":").c_str(), 1);
}

}  // namespace orthodyn
