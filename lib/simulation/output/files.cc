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

constexpr std::size_t kReserved = 16384;  // bytes beyond the first content

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

// One call to the system, as a rule: somebody who reads, or a signal that ends us, finds the old end or the new one.
void GrowingFile::append(const std::string& entry) {
  write_at_end(entry + tail_);
  size_ += entry.size();
  print_.add_piece(entry);
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

void GrowingFile::save(Archive& archive) const {
  make_lasting(path_);
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
    throw ConfigError(path_.string(), fmt::format("cannot be read{}, but the checkpoint goes on writing to it; {}",
                                                  ec ? " (" + ec.message() + ")" : "", kPutBack));
  if (found < size_)
    throw ConfigError(path_.string(), fmt::format("has {} bytes, but the checkpoint knows of {}: the end is lost; {}",
                                                  found, size_, kPutBack));
  print_ = fingerprint_of_begin(in, size_);
  if (print_.number() != archive.number("fingerprint"))
    throw ConfigError(path_.string(), fmt::format("is damaged: its first {} bytes are not those that the checkpoint "
                                                  "knows of; {}",
                                                  size_, kPutBack));
}

void GrowingFile::go_on() {
  open(0);
  write_at_end(tail_);
  if (!writes_files()) return;
  if (::ftruncate(file_, static_cast<off_t>(size_ + tail_.size())) != 0) fail_to_write(path_);
}

CsvFile::CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header)
    : file_(path, fmt::format("{}\n", fmt::join(header, ",")), "") {}

void CsvFile::row(const std::vector<double>& values) { file_.append(fmt::format("{}\n", fmt::join(values, ","))); }

}  // namespace orthodyn
