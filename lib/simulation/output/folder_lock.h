// Locks a folder for one process, or for several of one kind, during the lifetime of the lock. A killed process
// releases its lock.
#pragma once

#include <filesystem>
#include <string>

namespace orthodyn {

enum class Sharing { exclusive, shared };

class FolderLock {
 public:
  // Creates the folder and, in it, the lock file (flock). The file must never be renamed or replaced, and remains when
  // the lock is released. Throws ConfigError if another process holds the lock ("another <work> is at work there") or
  // the folder is not writable, RunError if the disk is full or broken. On a file system without locks, nothing is
  // locked and warning() says so.
  FolderLock(const std::filesystem::path& folder, const std::string& file, const std::string& work,
             Sharing sharing = Sharing::exclusive);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  const std::string& warning() const { return warning_; }  // empty if the folder is locked

 private:
  int file_ = -1;
  std::string warning_;
};

}  // namespace orthodyn
