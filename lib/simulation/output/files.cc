#include "lib/simulation/output/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr std::size_t kReserved = 16384;  // bytes reserved beyond the first content

Fingerprint fingerprint_of_begin(std::istream& in, std::size_t size) {
  constexpr std::size_t kPiece = 1 << 20;
  Fingerprint print;
  std::string piece;
  for (std::size_t left = size; left > 0 && in; left -= std::min(left, piece.size())) {
    piece.resize(std::min(left, kPiece));
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    print.add_piece({piece.data(), static_cast<std::size_t>(in.gcount())});
  }
  return print;
}

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
  print_ = {};
  append(head_);
}

// Normally makes one system call, so that a reader finds either the old end or the new one, even if a signal ends the
// program.
void GrowingFile::append(const std::string& entry) {
  write_at_end(entry + tail_);
  size_ += entry.size();
  print_.add_piece(entry);
}

void GrowingFile::write_at_end(const std::string& text) {
  if (!writes_files()) return;
  if (write_all(file_, text, size_)) return;
  const int error = errno;
  // Restores the end mark, for which there was space before.
  if (write_all(file_, tail_, size_))
    static_cast<void>(::ftruncate(file_, static_cast<off_t>(size_ + tail_.size())) == 0);
  errno = error;
  fail_to_write(path_);
}

void GrowingFile::save(Archive& archive) const {
  sync_to_disk(path_);
  archive.put_count("bytes", size_);
  archive.put("fingerprint", print_.number());
}

void GrowingFile::restore(const Archive& archive) {
  size_ = archive.count("bytes");
  print_ = {};
  if (!writes_files()) return;
  std::ifstream in(path_, std::ios::binary);
  std::error_code ec;
  const auto found = std::filesystem::file_size(path_, ec);
  if (ec || !in)
    throw ConfigError(path_.string(),
                      fmt::format("cannot be read{}, but resuming from the checkpoint continues this file; {}",
                                  ec ? " (" + ec.message() + ")" : "", kPutBack));
  if (found < size_)
    throw ConfigError(path_.string(),
                      fmt::format("has {} bytes, but {} when the checkpoint was written: the end is lost; {}", found,
                                  size_, kPutBack));
  print_ = fingerprint_of_begin(in, size_);
  if (print_.number() != archive.number("fingerprint"))
    throw ConfigError(
        path_.string(),
        fmt::format("is damaged: its first {} bytes have changed since the checkpoint; {}", size_, kPutBack));
}

void GrowingFile::reopen() {
  open(0);
  write_at_end(tail_);
  if (!writes_files()) return;
  if (::ftruncate(file_, static_cast<off_t>(size_ + tail_.size())) != 0) fail_to_write(path_);
}

CsvFile::CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header)
    : GrowingFile(path, fmt::format("{}\n", fmt::join(header, ",")), "") {}

void CsvFile::row(const std::vector<double>& values) { append(fmt::format("{}\n", fmt::join(values, ","))); }

PvdFile::PvdFile(const std::filesystem::path& path)
    : GrowingFile(path, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n",
                  "</Collection>\n</VTKFile>\n") {}

void PvdFile::add(double time, const std::string& file) {
  append(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file));
}

DiskReserve::DiskReserve(const std::filesystem::path& folder, std::size_t bytes) {
  if (!writes_files()) return;
  std::string name = (folder / "reserve.XXXXXX").string();
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) return;
  unlink(name.c_str());
  if (posix_fallocate(file_, 0, static_cast<off_t>(bytes)) != 0) release();
}

void DiskReserve::release() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

}  // namespace orthodyn
