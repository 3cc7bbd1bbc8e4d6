// The folder of a comparison: marked as such, and used by one process at a time.
#pragma once

#include <filesystem>

namespace orthodyn {

class ComparisonFolder {
 public:
  // Makes the folder if it is missing. Throws ConfigError if it holds anything else than a comparison, or
  // if another process works there. Finished points are known by their fingerprints, so any comparison may
  // go on in the folder of another.
  explicit ComparisonFolder(std::filesystem::path path);
  ~ComparisonFolder();
  ComparisonFolder(const ComparisonFolder&) = delete;
  ComparisonFolder& operator=(const ComparisonFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // open file of the mark
};

}  // namespace orthodyn
