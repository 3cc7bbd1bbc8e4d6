// Decodes the bytes of an array of a .vtu file: raw or base64, uncompressed or zlib.
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
  bool swap = false;             // the byte order differs from that of this machine
  std::size_t header_width = 4;  // bytes per length field: 4 or 8
};

// Called with the size of an array (bytes) before the array is unpacked. Throws std::runtime_error if the size is not
// allowed.
using AdmitBytes = std::function<void(std::uint64_t bytes)>;

// Decodes the start of `text`: a length and its bytes, or a table of compressed blocks and the blocks. Throws
// std::runtime_error with the cause.
std::string vtu_bytes(std::string_view text, const VtuEncoding& encoding, const AdmitBytes& admit);

// Reverses the bytes of each number of this width.
void swap_bytes(std::string& bytes, std::size_t width);

}  // namespace orthodyn
