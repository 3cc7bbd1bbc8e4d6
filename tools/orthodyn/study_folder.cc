#include "tools/orthodyn/study_folder.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Made first, and never by anybody else.
std::string mark_of(const std::string& kind) { return ".orthodyn-" + kind; }

void refuse_other_folders(const fs::path& path, const std::string& kind) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (!fs::is_directory(path, ec))
    throw ConfigError(fmt::format("{}: is a file, expected a folder for the results; use --out", path.string()));
  if (fs::is_empty(path, ec) || fs::exists(path / mark_of(kind), ec)) return;
  throw ConfigError(fmt::format("{}: holds files that are no {}; use --out with another folder", path.string(), kind));
}

}  // namespace

StudyFolder::StudyFolder(fs::path path, const std::string& kind, Sharing sharing) : path_(std::move(path)) {
  refuse_other_folders(path_, kind);
  lock_.emplace(path_, mark_of(kind), kind, sharing);
}

}  // namespace orthodyn
