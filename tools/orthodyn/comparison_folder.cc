#include "tools/orthodyn/comparison_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lib/core/errors.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Made first, and never by anybody else.
constexpr const char* kMark = ".orthodyn-comparison";

void refuse_other_folders(const fs::path& path) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (!fs::is_directory(path, ec))
    throw ConfigError(fmt::format("{}: is a file, expected a folder for the results; use --out", path.string()));
  if (fs::is_empty(path, ec) || fs::exists(path / kMark, ec)) return;
  throw ConfigError(fmt::format("{}: holds files that are no comparison; use --out with another folder", path.string()));
}

}  // namespace

ComparisonFolder::ComparisonFolder(fs::path path) : path_(std::move(path)) {
  refuse_other_folders(path_);
  std::error_code ec;
  fs::create_directories(path_, ec);
  if (!ec) lock_ = open((path_ / kMark).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0)
    throw RunError(fmt::format("{}: cannot write there: {}", path_.string(), ec ? ec.message() : std::strerror(errno)));
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  close(lock_);
  throw ConfigError(fmt::format("{}: another comparison is at work there; wait for it, or use --out", path_.string()));
}

ComparisonFolder::~ComparisonFolder() { close(lock_); }

}  // namespace orthodyn
