// Keeps a folder to one process at a time, or to several of one kind, for as long as it lives; a process that is killed
// lets go too.
#pragma once

#include <filesystem>
#include <string>

namespace orthodyn {

enum class Sharing { alone, with_its_like };

class FolderLock {
 public:
  // Makes the folder, and in it the file that is locked (flock), which stays: it must never be renamed or
  // replaced. Throws ConfigError if another process holds it ("another <work> is at work there") or the folder
  // cannot be written to, RunError if the disk is full or broken. Where the file system has no locks, it holds nothing,
  // and warning() says so.
  FolderLock(const std::filesystem::path& folder, const std::string& file, const std::string& work,
             Sharing sharing = Sharing::alone);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  const std::string& warning() const { return warning_; }  // empty if the folder is locked

 private:
  int file_ = -1;
  std::string warning_;
};

}  // namespace orthodyn
