// Whether a path is a file, a folder, or either. All functions return false if the system cannot look the path up (too
// long, no permission, circular links); opening the file then reports the cause.
#pragma once

#include <filesystem>

namespace orthodyn {

inline bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace orthodyn
