#include "tools/orthodyn/study_folder.h"

#include <fmt/format.h>

#include "lib/core/errors.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Made first, and never by anybody else.
std::string mark_of(const std::string& kind) { return ".orthodyn-" + kind; }

void refuse_other_folders(const fs::path& path, const std::string& kind) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (!fs::is_directory(path, ec))
    throw ConfigError(path.string(), "is a file, expected a folder for the results; use --out");
  if (fs::is_empty(path, ec) || fs::exists(path / mark_of(kind), ec)) return;
  throw ConfigError(path.string(), fmt::format("holds files that are no {}; use --out with another folder", kind));
}

// A table says which file it is of; one that is gone may have been renamed.
void refuse_other_tables(const fs::path& path, const std::string& kind, const fs::path& file) {
  const Json table = read_json(path / (kind == "comparison" ? "compare.json" : kind + ".json"));
  if (!table.is_object() || !table.contains("file")) return;
  const std::string earlier = table.at("file");
  std::error_code ec;
  if (!fs::exists(earlier, ec) || fs::equivalent(earlier, file, ec)) return;
  throw ConfigError(path.string(),
                    fmt::format("holds the table of {}, which this one of {} would replace; use --out with another "
                                "folder",
                                earlier, file.string()));
}

}  // namespace

StudyFolder::StudyFolder(fs::path path, const std::string& kind, const fs::path& file, Sharing sharing)
    : path_(std::move(path)) {
  refuse_other_folders(path_, kind);
  refuse_other_tables(path_, kind, file);
  lock_.emplace(path_, mark_of(kind), kind, sharing);
  if (!lock_->warning().empty()) fmt::print(stderr, "warning: {}\n", lock_->warning());
}

}  // namespace orthodyn
