// Output files. All functions throw RunError, with the file and the reason, if a file cannot be written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/core/fingerprint.h"
#include "lib/core/write_file.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

// A small file that can be rewritten when the disk is full: the first write reserves space.
class ReservedFile {
 public:
  ReservedFile(std::filesystem::path path, const std::string& content);
  void rewrite(const std::string& content) const;

 private:
  std::filesystem::path path_;
  std::size_t room_;  // reserved size, bytes
};

// A file to which entries are appended and which is valid after each of them. An end mark may follow the last entry;
// the next entry overwrites it. The file is not touched before begin() or reopen().
class GrowingFile {
 public:
  GrowingFile(std::filesystem::path path, std::string head, std::string tail);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void begin();
  // The entry is written in one piece, and is in the file when the call returns.
  void append(const std::string& entry);

  // Syncs the file to the disk, and saves its length and fingerprint, without the end mark, in a checkpoint.
  void save(Archive& archive) const;
  // Throws ConfigError if the file does not start with the content at the time of save().
  void restore(const Archive& archive);
  // After restore(): opens the file of an earlier process and truncates it to the saved length.
  void reopen();

 private:
  void open(int flags);
  void write_at_end(const std::string& text);

  std::filesystem::path path_;
  std::string head_, tail_;
  int file_ = -1;
  std::size_t size_ = 0;  // bytes without the end mark
  Fingerprint print_;     // fingerprint of these bytes
};

// Remedy if a file does not match the checkpoint.
inline constexpr const char* kPutBack = "put it back, or start anew with --force instead of --resume";

// A CSV file. Each row is in the file when row() returns.
class CsvFile : public GrowingFile {
 public:
  CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header);
  void row(const std::vector<double>& values);
};

// A .pvd collection for ParaView: .vtu files by time.
class PvdFile : public GrowingFile {
 public:
  explicit PvdFile(const std::filesystem::path& path);
  // `file`: relative to the folder of the collection.
  void add(double time, const std::string& file);
};

// Disk space kept free for files that must still be written when the disk is full.
class DiskReserve {
 public:
  // Reserves space in a folder by an unnamed file, which vanishes however the program ends. Reserves nothing if there
  // is not enough space.
  DiskReserve(const std::filesystem::path& folder, std::size_t bytes);
  ~DiskReserve() { release(); }
  DiskReserve(const DiskReserve&) = delete;
  DiskReserve& operator=(const DiskReserve&) = delete;

  // Frees the space.
  void release();

 private:
  int file_ = -1;
};

}  // namespace orthodyn
