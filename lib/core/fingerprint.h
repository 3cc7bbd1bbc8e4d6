// What a result depends on, as a short text: equal inputs, equal fingerprints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace orthodyn {

// FNV-1a, 64 bits: enough to tell a few thousand inputs apart and to notice every damaged byte; no
// defence against malice.
class Fingerprint {
 public:
  Fingerprint& add(const std::string& text);
  // The file's content. Throws RunError if it cannot be read.
  Fingerprint& add_file(const std::filesystem::path& path);
  std::string text() const;  // 16 hexadecimal digits

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace orthodyn
