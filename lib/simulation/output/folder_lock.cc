#include "lib/simulation/output/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

// Throws RunError for a full or broken disk, which is not an input error, else ConfigError.
[[noreturn]] void refuse(const std::filesystem::path& folder, int error) {
  const std::string what = fmt::format("cannot write there: {}", std::strerror(error));
  if (error == ENOSPC || error == EDQUOT || error == EIO) throw RunError(fmt::format("{}: {}", folder.string(), what));
  throw ConfigError(folder.string(), what + "; use --out with another folder");
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& file, const std::string& work,
                       Sharing sharing) {
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  if (!ec) file_ = open((folder / file).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) refuse(folder, ec ? ec.value() : errno);
  if (flock(file_, (sharing == Sharing::exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return;
  if (errno != EWOULDBLOCK) {
    warning_ = fmt::format("{}: cannot be locked ({}); do not start another program there meanwhile", folder.string(),
                           std::strerror(errno));
    return;
  }
  close(file_);
  throw ConfigError(folder.string(), fmt::format("another {} is at work there; wait for it, or use --out", work));
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace orthodyn
