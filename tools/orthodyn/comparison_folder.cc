#include "tools/orthodyn/comparison_folder.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Made first, and never by anybody else.
constexpr const char* kMark = ".orthodyn-comparison";

void refuse_other_folders(const fs::path& path) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (!fs::is_directory(path, ec))
    throw ConfigError(fmt::format("{}: is a file, expected a folder for the results; use --out", path.string()));
  if (fs::is_empty(path, ec) || fs::exists(path / kMark, ec)) return;
  throw ConfigError(fmt::format("{}: holds files that are no comparison; use --out with another folder", path.string()));
}

}  // namespace

ComparisonFolder::ComparisonFolder(fs::path path) : path_(std::move(path)) {
  refuse_other_folders(path_);
  lock_.emplace(path_, kMark, "comparison");
}

}  // namespace orthodyn
