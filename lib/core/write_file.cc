#include "lib/core/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

bool file_writing_enabled = true;

// Result of fsync. Errors that mean "this file system cannot sync" count as success.
bool is_synced(int status) { return status == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS; }

// Writes into a device or a pipe, which must not be replaced by a file.
void write_in_place(const std::filesystem::path& path, const std::vector<std::string>& parts) {
  std::ofstream out(path, std::ios::binary);
  for (const auto& text : parts) out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail_to_write(path);
}

// A new temporary file beside the final one. It never opens an existing file or follows a link.
class PartialFile {
 public:
  explicit PartialFile(const std::filesystem::path& whole) {
    constexpr int kMost = 1000;
    static std::atomic<unsigned> count = 0;
    for (int attempt = 0; attempt < kMost && file_ < 0; ++attempt) {
      path_ = fmt::format("{}.{}-{}.part", whole.string(), ::getpid(), ++count);
      file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST && errno != EINTR) break;
    }
    if (file_ < 0) fail_to_write(whole);
  }
  ~PartialFile() {
    const int error = errno;
    if (file_ >= 0) ::close(file_);
    if (!path_.empty()) ::unlink(path_.c_str());
    errno = error;
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  // The following functions return false on failure, with the cause in errno.
  bool write(const std::vector<std::string>& parts) {
    for (const auto& text : parts) {
      if (!write_all(file_, text, size_)) return false;
      size_ += text.size();
    }
    return true;
  }
  bool sync_to_disk() const { return is_synced(::fsync(file_)); }
  bool rename_to(const std::filesystem::path& whole) {
    const bool closed = ::close(std::exchange(file_, -1)) == 0;  // some file systems write only now
    if (!closed || ::rename(path_.c_str(), whole.c_str()) != 0) return false;
    path_.clear();
    return true;
  }

 private:
  std::string path_;
  int file_ = -1;
  std::size_t size_ = 0;
};

void write_whole_file(const std::filesystem::path& path, const std::vector<std::string>& parts, bool durable) {
  if (!writes_files()) return;
  std::error_code ec;
  const auto kind = std::filesystem::status(path, ec).type();
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    return write_in_place(path, parts);
  make_folder_of(path);
  PartialFile part(path);
  if (!part.write(parts) || (durable && !part.sync_to_disk()) || !part.rename_to(path)) fail_to_write(path);
  if (durable) sync_to_disk(path.has_parent_path() ? path.parent_path() : ".");  // makes the new name durable
}

// Each removes something at the end of `name`, and returns false if it is not there.
bool remove_end(std::string_view& name, std::string_view end) {
  const bool found = name.ends_with(end);
  if (found) name.remove_suffix(end.size());
  return found;
}
bool remove_number(std::string_view& name) {
  const auto begin = name.find_last_not_of("0123456789") + 1;
  const bool found = begin < name.size();
  name = name.substr(0, begin);
  return found;
}

// True for the name of a PartialFile, such as run.json.123-4.part.
bool is_partial(std::string_view name) {
  return remove_end(name, ".part") && remove_number(name) && remove_end(name, "-") && remove_number(name) &&
         remove_end(name, ".") && !name.empty();
}

}  // namespace

bool writes_files() { return file_writing_enabled; }
void disable_file_writing() { file_writing_enabled = false; }

void fail_to_write(const std::filesystem::path& path) {
  throw RunError(fmt::format("cannot write {}: {}; free some space or choose another folder with --out", path.string(),
                             std::strerror(errno)),
                 Reason::disk);
}

bool write_all(int file, std::string_view text, std::size_t at) {
  while (!text.empty()) {
    const auto written = ::pwrite(file, text.data(), text.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void make_folder_of(const std::filesystem::path& path) {
  if (!writes_files()) return;
  std::error_code ec;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ec);
  errno = ec.value();
  if (ec) fail_to_write(path);
}

void write_file(const std::filesystem::path& path, const std::vector<std::string>& parts) {
  write_whole_file(path, parts, false);
}

void write_durable_file(const std::filesystem::path& path, const std::vector<std::string>& parts) {
  write_whole_file(path, parts, true);
}

void remove_partial_files(const std::filesystem::path& folder) {
  if (!writes_files()) return;
  std::error_code ec;
  std::vector<std::filesystem::path> found;
  for (auto at = std::filesystem::recursive_directory_iterator(folder, ec); !ec && at != end(at); at.increment(ec))
    if (at->symlink_status(ec).type() == std::filesystem::file_type::regular &&
        is_partial(at->path().filename().string()))
      found.push_back(at->path());
  for (const auto& path : found) std::filesystem::remove(path, ec);  // failures are harmless
}

void sync_to_disk(const std::filesystem::path& path) {
  if (!writes_files()) return;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_to_write(path);
  const bool synced = is_synced(::fsync(file));
  const int error = errno;
  ::close(file);
  errno = error;
  if (!synced) fail_to_write(path);
}

}  // namespace orthodyn
