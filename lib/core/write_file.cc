#include "lib/core/write_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {
bool leaves_files_to_others = false;
}

bool writes_files() { return !leaves_files_to_others; }
void leave_files_to_others() { leaves_files_to_others = true; }

void fail_to_write(const std::filesystem::path& path) {
  throw RunError(fmt::format("cannot write {}: {}; free some space or choose another folder with --out",
                             path.string(), std::strerror(errno)),
                 Reason::disk);
}

namespace {

// To a device or a pipe, in whose place no file may come.
void write_in_place(const std::filesystem::path& path, const std::vector<std::string>& parts) {
  std::ofstream out(path, std::ios::binary);
  for (const auto& text : parts) out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail_to_write(path);
}

void write_whole_file(const std::filesystem::path& path, const std::vector<std::string>& parts, bool lasting) {
  if (!writes_files()) return;
  std::error_code ec;
  const auto kind = std::filesystem::status(path, ec).type();
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    return write_in_place(path, parts);
  make_folder_of(path);
  const std::filesystem::path part = path.string() + ".part";
  try {
    write_in_place(part, parts);
    if (lasting) make_lasting(part);
    std::filesystem::rename(part, path, ec);
    errno = ec.value();
    if (ec) fail_to_write(path);
  } catch (const RunError&) {
    const int error = errno;
    std::filesystem::remove(part, ec);
    errno = error;
    fail_to_write(path);
  }
  if (lasting) make_lasting(path.has_parent_path() ? path.parent_path() : ".");  // the new name
}

}  // namespace

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

void write_lasting_file(const std::filesystem::path& path, const std::vector<std::string>& parts) {
  write_whole_file(path, parts, true);
}

void make_lasting(const std::filesystem::path& path) {
  if (!writes_files()) return;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_to_write(path);
  const int status = ::fsync(file);
  const int error = errno;
  ::close(file);
  errno = error;
  // Some file systems cannot sync a folder, or anything, and say so.
  if (status != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail_to_write(path);
}

}  // namespace orthodyn
