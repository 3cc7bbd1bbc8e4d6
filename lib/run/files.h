// Output files that say so when they cannot be written. All throw RunError.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace orthodyn {

// Writes the parts one after the other. To a neighbouring name first, then renamed: the file is
// whole or absent. Its folder is made.
void write_file(const std::filesystem::path& path, const std::vector<std::string>& parts);

// A small file that can be rewritten although the disk is full: the first write reserves room.
class ReservedFile {
 public:
  ReservedFile(std::filesystem::path path, const std::string& content);
  void rewrite(const std::string& content) const;

 private:
  std::filesystem::path path_;
};

// A CSV file whose rows are on disk as soon as they are written.
class CsvFile {
 public:
  CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header);
  void row(const std::vector<double>& values);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

}  // namespace orthodyn
