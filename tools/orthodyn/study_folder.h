// The folder of a study, such as a comparison: marked as such, and used by one process at a time, or by several that
// only add points.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lib/simulation/output/folder_lock.h"

namespace orthodyn {

class StudyFolder {
 public:
  // Makes the folder if it is missing. `kind`: "comparison"; `file`: the study's. Throws ConfigError if the folder
  // holds anything else than a study of this kind, or the table of another file, or if another process works there.
  // What is finished is known by its fingerprint: a file that has been edited goes on where it was.
  StudyFolder(std::filesystem::path path, const std::string& kind, const std::filesystem::path& file,
              Sharing sharing = Sharing::alone);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;  // on the mark; taken once the folder is known to be ours
};

}  // namespace orthodyn
