// The result folder of a run, locked for its lifetime. An earlier result is changed only on request.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lib/simulation/output/folder_lock.h"

namespace orthodyn {

enum class EarlierResult { keep, replace, resume };  // what to do about an earlier result

class ResultFolder {
 public:
  // Throws ConfigError if the folder holds an earlier result to be kept, a result that cannot be resumed, or other
  // files; if another run holds the lock; and if the folder is not writable. Leaves the result unchanged, but may
  // create the lock file and remove partial files. `warn` is called if the folder cannot be locked.
  ResultFolder(std::filesystem::path path, EarlierResult earlier, std::function<void(const std::string&)> warn);

  // Creates the folder and removes an earlier result. Throws RunError; ConfigError if the folder cannot be created or
  // another run has started there.
  void prepare();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path checkpoint() const;
  // True if there is a checkpoint to resume from.
  bool resumes() const { return resumes_; }
  // True if the run to resume is completed and has no checkpoint.
  bool is_completed_without_checkpoint() const { return completed_; }
  // How the earlier run ended: "completed", "interrupted", "failed", or "killed" if unknown.
  std::string earlier_status() const;

 private:
  void lock();
  void refuse_earlier_result() const;
  void find_checkpoint();

  std::filesystem::path path_;
  EarlierResult earlier_;
  std::function<void(const std::string&)> warn_;
  std::optional<FolderLock> lock_;  // empty while the folder does not exist
  bool resumes_ = false, completed_ = false;
};

}  // namespace orthodyn
