// The folder that a run writes to, alone for as long as this lives. An earlier result is never touched
// without being asked to.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lib/simulation/output/folder_lock.h"

namespace orthodyn {

enum class Earlier { keep, replace, resume };  // what to do about an earlier result

class ResultFolder {
 public:
  // Throws ConfigError if the folder holds an earlier result that is to be kept, one that cannot be
  // resumed, or anything else, if another run is at work there, and if it cannot be written to. Touches nothing yet.
  // `warn` is told if the folder cannot be locked.
  ResultFolder(std::filesystem::path path, Earlier earlier, std::function<void(const std::string&)> warn);

  // Makes the folder and removes an earlier result from it. Throws RunError, and ConfigError if it cannot be made or
  // another run has been there since.
  void prepare();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path checkpoint() const;
  // There is a checkpoint, and it is to be used.
  bool resumes() const { return resumes_; }
  // It was to be resumed, completed, and has no checkpoint.
  bool is_completed_without_checkpoint() const { return completed_; }
  // How the earlier run ended: "completed", "interrupted", "failed", or "killed" if it cannot tell.
  std::string earlier_status() const;

 private:
  void lock();
  void refuse_earlier_result() const;
  void consider_resuming();

  std::filesystem::path path_;
  Earlier earlier_;
  std::function<void(const std::string&)> warn_;
  std::optional<FolderLock> lock_;  // none while there is no folder
  bool resumes_ = false, completed_ = false;
};

}  // namespace orthodyn
