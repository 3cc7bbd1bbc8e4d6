#include "lib/simulation/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lib/core/errors.h"

namespace orthodyn {

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& file, const std::string& work,
                       Sharing sharing) {
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  if (!ec) file_ = open((folder / file).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw RunError(
        fmt::format("{}: cannot write there: {}", folder.string(), ec ? ec.message() : std::strerror(errno)));
  if (flock(file_, (sharing == Sharing::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return;
  if (errno != EWOULDBLOCK) {
    warning_ = fmt::format("{}: cannot be locked ({}); start nothing else there meanwhile", folder.string(),
                           std::strerror(errno));
    return;
  }
  close(file_);
  throw ConfigError(folder.string(), fmt::format("another {} is at work there; wait for it, or use --out", work));
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace orthodyn
