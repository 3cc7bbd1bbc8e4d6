// The folder of a comparison: marked as such, and used by one process at a time.
#pragma once

#include <filesystem>
#include <optional>

#include "tools/orthodyn/folder_lock.h"

namespace orthodyn {

class ComparisonFolder {
 public:
  // Makes the folder if it is missing. Throws ConfigError if it holds anything else than a comparison, or
  // if another process works there. Finished points are known by their fingerprints, so any comparison may
  // go on in the folder of another.
  explicit ComparisonFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;  // on the mark; taken once the folder is known to be ours
};

}  // namespace orthodyn
