// What stands under a name. A name that the system cannot look up (too long, in a folder that may not be entered, links
// in a circle) has nothing there: whoever opens it is told why.
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
