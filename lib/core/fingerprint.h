// A hash of the inputs of a result: equal inputs have equal fingerprints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace orthodyn {

// FNV-1a with 64 bits. It separates a few thousand inputs and detects any single changed byte. Not cryptographic.
class Fingerprint {
 public:
  Fingerprint& add(const std::string& text);
  // Adds a piece of a longer text; the result does not depend on where the text is cut.
  Fingerprint& add_piece(std::string_view piece);
  // Adds the content of a file. Throws RunError if it cannot be read.
  Fingerprint& add_file(const std::filesystem::path& path);
  std::string text() const;  // 16 hexadecimal digits
  // The lowest 53 bits, which a double represents exactly. They also detect any single changed byte.
  double number() const { return static_cast<double>(hash_ & ((std::uint64_t{1} << 53) - 1)); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace orthodyn
