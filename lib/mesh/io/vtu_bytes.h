// The bytes of one array of a .vtu file, out of raw or base64 text, uncompressed or by zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace orthodyn {

struct VtuEncoding {
  bool base64 = false;
  bool zlib = false;
  bool swap = false;             // numbers have the other byte order than this machine
  std::size_t header_width = 4;  // bytes of each length: 4 or 8
};

// Is told how many bytes will come, and throws std::runtime_error if these are too many or too few.
using AdmitBytes = std::function<void(std::uint64_t bytes)>;

// What stands at the start of `text`: a length and its bytes, or the table of compressed blocks
// and these. Nothing is unpacked before it is admitted. Throws std::runtime_error with what is wrong.
std::string vtu_bytes(std::string_view text, const VtuEncoding& encoding, const AdmitBytes& admit);

// Reverses the bytes of each number of this width.
void swap_bytes(std::string& bytes, std::size_t width);

}  // namespace orthodyn
