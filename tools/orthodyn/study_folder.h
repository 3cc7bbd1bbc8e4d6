// The folder of a comparison or a sweep: marked as such, and used by one process at a time, or by several that only add
// points.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/orthodyn/folder_lock.h"

namespace orthodyn {

class StudyFolder {
 public:
  // `kind`: "comparison". Makes the folder if it is missing. Throws ConfigError if it holds anything else than such a
  // study, or if another process works there. Finished points are known by their fingerprints, so any study may go on in
  // the folder of another of its kind.
  StudyFolder(std::filesystem::path path, const std::string& kind, Sharing sharing = Sharing::alone);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;  // on the mark; taken once the folder is known to be ours
};

}  // namespace orthodyn
