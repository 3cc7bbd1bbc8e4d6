#include "lib/run/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstring>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw RunError(fmt::format("cannot write {}: {}; free some space or choose another folder with --out",
                             path.string(), std::strerror(errno)));
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::vector<std::string>& parts) {
  std::error_code ignored;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  const std::filesystem::path part = path.string() + ".part";
  {
    std::ofstream out(part, std::ios::binary);
    for (const auto& text : parts) out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
      const int error = errno;
      std::filesystem::remove(part, ignored);
      errno = error;
      fail(path);
    }
  }
  std::error_code ec;
  std::filesystem::rename(part, path, ec);
  if (ec) fail(path);
}

namespace {
constexpr std::size_t kReserved = 16384;

std::string padded(std::string text) {
  if (text.size() < kReserved) text.append(kReserved - text.size(), '\n');
  return text;
}
}  // namespace

ReservedFile::ReservedFile(std::filesystem::path path, const std::string& content) : path_(std::move(path)) {
  write_file(path_, {padded(content)});
}

void ReservedFile::rewrite(const std::string& content) const {
  std::fstream out(path_, std::ios::in | std::ios::out | std::ios::binary);
  const std::string text = padded(content);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail(path_);
  std::filesystem::resize_file(path_, content.size());
}

CsvFile::CsvFile(const std::filesystem::path& path, const std::vector<std::string>& header)
    : path_(path), out_(path) {
  out_ << fmt::format("{}\n", fmt::join(header, ",")) << std::flush;
  if (!out_) fail(path_);
}

void CsvFile::row(const std::vector<double>& values) {
  out_ << fmt::format("{}\n", fmt::join(values, ",")) << std::flush;
  if (!out_) fail(path_);
}

}  // namespace orthodyn
