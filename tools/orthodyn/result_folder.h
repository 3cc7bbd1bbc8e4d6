// The folder that a run writes to. An earlier result is never touched without being asked to.
#pragma once

#include <filesystem>
#include <string>

namespace orthodyn {

class ResultFolder {
 public:
  // Throws ConfigError if the folder holds an earlier result and `force` is not set, or holds
  // anything else. Touches nothing yet.
  ResultFolder(std::filesystem::path path, bool force);

  // Makes the folder and removes an earlier result from it. Throws RunError.
  void prepare() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace orthodyn
