// Output files that say so when they cannot be written. All throw RunError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/core/write_file.h"
#include "lib/simulation/observers/archive.h"

namespace orthodyn {

// A small file that can be rewritten although the disk is full: the first write reserves room.
class ReservedFile {
 public:
  ReservedFile(std::filesystem::path path, const std::string& content);
  void rewrite(const std::string& content) const;

 private:
  std::filesystem::path path_;
  std::size_t room_;  // bytes
};

// A file to which entries are appended, and which is whole after each of them: an end mark may follow
// the last entry and is overwritten by the next. Nothing is touched before begin() or go_on().
class GrowingFile {
 public:
  GrowingFile(std::filesystem::path path, std::string head, std::string tail);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void begin();
  // In one piece, and before the next call returns in the file.
  void append(const std::string& entry);
  // Bytes without the end mark.
  std::size_t size() const { return size_; }

  // Opens what an earlier process has written and cuts it down to `size`.
  void go_on(std::size_t size);
  // Throws ConfigError if the file has fewer bytes than that.
  void require(std::size_t size) const;
  void make_lasting() const;

 private:
  void open(int flags);
  void write_at_end(const std::string& text);

  std::filesystem::path path_;
  std::string head_, tail_;
  int file_ = -1;
  std::size_t size_ = 0;
};

// A CSV file whose rows are in the file as soon as they are written.
class CsvFile {
 public:
  CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header);
  void begin() { file_.begin(); }
  void row(const std::vector<double>& values);

  // Its length, for a checkpoint; what was written is on the disk afterwards.
  void save(Archive& archive) const;
  void restore(const Archive& archive);
  // After restore().
  void go_on() { file_.go_on(kept_); }

 private:
  GrowingFile file_;
  std::size_t kept_ = 0;
};

}  // namespace orthodyn
