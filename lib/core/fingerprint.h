// What a result depends on, as a short text: equal inputs, equal fingerprints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace orthodyn {

// FNV-1a, 64 bits: enough to tell a few thousand inputs apart and to notice every damaged byte; no
// defence against malice.
class Fingerprint {
 public:
  Fingerprint& add(const std::string& text);
  // Goes on with a text that comes in pieces, wherever it is cut.
  Fingerprint& add_piece(std::string_view piece);
  // The file's content. Throws RunError if it cannot be read.
  Fingerprint& add_file(const std::filesystem::path& path);
  std::string text() const;  // 16 hexadecimal digits
  // 53 bits of it, which a double holds. A single byte that differs changes these as well.
  double number() const { return static_cast<double>(hash_ & ((std::uint64_t{1} << 53) - 1)); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace orthodyn
