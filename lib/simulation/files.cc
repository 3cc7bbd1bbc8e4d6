#include "lib/simulation/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {
constexpr std::size_t kReserved = 16384;  // bytes beyond the first content
}  // namespace

ReservedFile::ReservedFile(std::filesystem::path path, const std::string& content)
    : path_(std::move(path)), room_(content.size() + kReserved) {
  write_file(path_, {content, std::string(kReserved, '\n')});
}

void ReservedFile::rewrite(const std::string& content) const {
  if (!writes_files()) return;
  const int file = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail_to_write(path_);
  std::string text = content;
  if (text.size() < room_) text.append(room_ - text.size(), '\n');
  const bool written = write_all(file, text, 0) && ::ftruncate(file, static_cast<off_t>(content.size())) == 0;
  const int error = errno;
  const bool closed = ::close(file) == 0;
  if (!written) errno = error;
  if (!written || !closed) fail_to_write(path_);
}

GrowingFile::GrowingFile(std::filesystem::path path, std::string head, std::string tail)
    : path_(std::move(path)), head_(std::move(head)), tail_(std::move(tail)) {}

GrowingFile::~GrowingFile() {
  if (file_ >= 0) ::close(file_);
}

void GrowingFile::open(int flags) {
  if (!writes_files()) return;
  if (file_ >= 0) ::close(file_);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (file_ < 0) fail_to_write(path_);
}

void GrowingFile::begin() {
  make_folder_of(path_);
  open(O_CREAT | O_TRUNC);
  size_ = 0;
  append(head_);
}

// One call to the system, as a rule: somebody who reads, or a signal that ends us, finds the old end or the new one.
void GrowingFile::append(const std::string& entry) {
  write_at_end(entry + tail_);
  size_ += entry.size();
}

void GrowingFile::write_at_end(const std::string& text) {
  if (!writes_files()) return;
  if (write_all(file_, text, size_)) return;
  const int error = errno;
  // Back to the end mark, for which there was room before.
  if (write_all(file_, tail_, size_))
    static_cast<void>(::ftruncate(file_, static_cast<off_t>(size_ + tail_.size())) == 0);
  errno = error;
  fail_to_write(path_);
}

void GrowingFile::require(std::size_t size) const {
  if (!writes_files()) return;
  std::error_code ec;
  const auto found = std::filesystem::file_size(path_, ec);
  if (ec)
    throw ConfigError(path_.string(),
                      fmt::format("cannot be read ({}), but the checkpoint goes on writing to it; put it back, or "
                                  "start anew with --force in place of --resume",
                                  ec.message()));
  if (found < size)
    throw ConfigError(path_.string(),
                      fmt::format("has {} bytes, but the checkpoint knows of {}: the end is lost; start anew with "
                                  "--force in place of --resume",
                                  found, size));
}

void GrowingFile::go_on(std::size_t size) {
  open(0);
  size_ = size;
  write_at_end(tail_);
  if (!writes_files()) return;
  if (::ftruncate(file_, static_cast<off_t>(size_ + tail_.size())) != 0) fail_to_write(path_);
}

void GrowingFile::make_lasting() const { orthodyn::make_lasting(path_); }

CsvFile::CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header)
    : file_(path, fmt::format("{}\n", fmt::join(header, ",")), "") {}

void CsvFile::row(const std::vector<double>& values) { file_.append(fmt::format("{}\n", fmt::join(values, ","))); }

void CsvFile::save(Archive& archive) const {
  file_.make_lasting();
  archive.put_count("bytes", file_.size());
}

void CsvFile::restore(const Archive& archive) {
  kept_ = archive.count("bytes");
  file_.require(kept_);
}

}  // namespace orthodyn
