#include "tools/orthodyn/result_folder.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// run.json is written first: a folder with it is a result of ours.
constexpr const char* kMark = "run.json";
constexpr const char* kOurs[] = {"frames", "frames.pvd", "probes.csv", "energy.csv", "momentum.csv",
                                 "steps.csv", "scene.yaml", "pictures", kMark};

}  // namespace

ResultFolder::ResultFolder(fs::path path, bool force) : path_(std::move(path)) {
  std::error_code ec;
  if (!fs::exists(path_, ec)) return;
  if (!fs::is_directory(path_, ec))
    throw ConfigError(fmt::format("{}: is a file, expected a folder for the results; use --out", path_.string()));
  if (fs::is_empty(path_, ec)) return;
  if (!fs::exists(path_ / kMark, ec))
    throw ConfigError(fmt::format("{}: holds files that are no result of a run; use --out with another folder",
                                  path_.string()));
  if (!force)
    throw ConfigError(fmt::format("{}: holds an earlier result; use --force to replace it, or --out with another "
                                  "folder",
                                  path_.string()));
}

void ResultFolder::prepare() const {
  std::error_code ec;
  fs::create_directories(path_, ec);
  if (!ec)
    for (const char* name : kOurs) fs::remove_all(path_ / name, ec);
  if (ec) throw RunError(fmt::format("cannot prepare the folder {}: {}", path_.string(), ec.message()));
}

}  // namespace orthodyn
