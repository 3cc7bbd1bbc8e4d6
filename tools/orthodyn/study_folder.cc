#include "tools/orthodyn/study_folder.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

void refuse_other_folders(const fs::path& path, const std::string& kind, const std::string& mark) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (!fs::is_directory(path, ec))
    throw ConfigError(fmt::format("{}: is a file, expected a folder for the results; use --out", path.string()));
  if (fs::is_empty(path, ec) || fs::exists(path / mark, ec)) return;
  throw ConfigError(fmt::format("{}: holds files that are no {}; use --out with another folder", path.string(), kind));
}

}  // namespace

StudyFolder::StudyFolder(fs::path path, const std::string& kind, Sharing sharing) : path_(std::move(path)) {
  const std::string mark = ".orthodyn-" + kind;  // made first, and never by anybody else
  refuse_other_folders(path_, kind, mark);
  lock_.emplace(path_, mark, kind, sharing);
}

}  // namespace orthodyn
