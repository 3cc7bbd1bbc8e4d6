#include "lib/mesh/io/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "lib/core/errors.h"

namespace orthodyn {

std::string read_text_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw ConfigError(fmt::format("{}: cannot be opened: {}", path, error.message()));
  }
  if (!std::filesystem::is_regular_file(status)) {  // a pipe might never end
    throw ConfigError(path + ": a directory or device, where a mesh file is expected");
  }
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
  if (size < 0)
    throw ConfigError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  stream.read(text.data(), size);
  if (!stream) throw ConfigError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  return text;
}

}  // namespace orthodyn
