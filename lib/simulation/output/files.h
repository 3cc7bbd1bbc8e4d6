// Output files that say so when they cannot be written. All throw RunError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/core/fingerprint.h"
#include "lib/core/write_file.h"
#include "lib/simulation/checkpoint/archive.h"

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

  // Its length and fingerprint without the end mark, for a checkpoint; what was written is on the disk afterwards.
  void save(Archive& archive) const;
  // Throws ConfigError if the file does not begin with what save() knew of.
  void restore(const Archive& archive);
  // After restore(): opens what an earlier process has written and cuts it down to what save() knew of.
  void go_on();

 private:
  void open(int flags);
  void write_at_end(const std::string& text);

  std::filesystem::path path_;
  std::string head_, tail_;
  int file_ = -1;
  std::size_t size_ = 0;  // bytes without the end mark
  Fingerprint print_;     // of these
};

// What to do where results are not as a checkpoint knows them.
inline constexpr const char* kPutBack = "put it back, or start anew with --force in place of --resume";

// A CSV file whose rows are in the file as soon as they are written.
class CsvFile {
 public:
  CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header);
  void begin() { file_.begin(); }
  void row(const std::vector<double>& values);

  // As a GrowingFile.
  void save(Archive& archive) const { file_.save(archive); }
  void restore(const Archive& archive) { file_.restore(archive); }
  void go_on() { file_.go_on(); }

 private:
  GrowingFile file_;
};

}  // namespace orthodyn
