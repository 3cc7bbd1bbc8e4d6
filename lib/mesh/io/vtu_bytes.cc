#include "lib/mesh/io/vtu_bytes.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

namespace orthodyn {
namespace {

// Deflate reaches at most 1032:1.
constexpr std::uint64_t kMaxZlibRatio = 1100;

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

// Sequential reader of bytes. Writers encode lengths and data as one base64 text or as two, so that padding may occur
// in the middle.
class ByteSource {
 public:
  ByteSource(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  // Throws if the text is too short for `count` bytes; base64 text is longer than its bytes.
  void expect(std::uint64_t count) const {
    if (count > text_.size() + buffer_.size())
      throw std::runtime_error(fmt::format("{} bytes announced, but the file ends before; is it truncated?", count));
  }

  std::string take(std::uint64_t count) {
    expect(count);
    const auto n = static_cast<std::size_t>(count);
    if (!base64_) {
      std::string bytes(text_.substr(0, n));
      text_.remove_prefix(n);
      return bytes;
    }
    while (buffer_.size() < n) decode_group();
    std::string bytes = buffer_.substr(0, n);
    buffer_.erase(0, n);
    return bytes;
  }

 private:
  void decode_group() {
    unsigned bits = 0;
    int digits = 0;
    int padding = 0;
    while (digits + padding < 4) {
      while (!text_.empty() && is_space(text_.front())) text_.remove_prefix(1);
      if (text_.empty()) throw std::runtime_error("base64 data end early; is the file truncated?");
      const char c = text_.front();
      text_.remove_prefix(1);
      if (c == '=' && digits >= 2) {
        ++padding;
        bits <<= 6;
        continue;
      }
      const int value = base64_value(c);
      if (value < 0 || padding > 0) throw std::runtime_error("a character that is not base64");
      bits = (bits << 6) | static_cast<unsigned>(value);
      ++digits;
    }
    for (int k = 0; k < digits - 1; ++k) buffer_ += static_cast<char>((bits >> (16 - 8 * k)) & 0xff);
  }

  std::string_view text_;
  bool base64_;
  std::string buffer_;  // decoded, not taken yet
};

std::uint64_t take_length(ByteSource& source, const VtuEncoding& encoding) {
  std::string bytes = source.take(encoding.header_width);
  if (encoding.swap) swap_bytes(bytes, encoding.header_width);
  if (encoding.header_width == 4) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    return length;
  }
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), 8);
  return length;
}

void append_inflated(const std::string& compressed, std::uint64_t size, std::string& out) {
  if (size > kMaxZlibRatio * compressed.size() + 64)
    throw std::runtime_error(
        fmt::format("{} compressed bytes cannot unpack to a block of {} bytes", compressed.size(), size));
  const std::size_t begin = out.size();
  out.resize(begin + static_cast<std::size_t>(size) + 1);  // one more byte, so that the buffer is never empty
  uLongf length = static_cast<uLongf>(size) + 1;
  const int status =
      uncompress(reinterpret_cast<Bytef*>(out.data() + begin), &length,
                 reinterpret_cast<const Bytef*>(compressed.data()), static_cast<uLong>(compressed.size()));
  if (status != Z_OK || length != size) throw std::runtime_error("a damaged compressed block");
  out.resize(begin + static_cast<std::size_t>(size));
}

// Total size of all blocks, saturating at 2^64 - 1.
std::uint64_t sum_of_blocks(std::uint64_t blocks, std::uint64_t size, std::uint64_t last) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  if (blocks == 0) return 0;
  if (size > 0 && blocks - 1 > kMost / size) return kMost;
  const std::uint64_t before = (blocks - 1) * size, end = last != 0 ? last : size;
  return end > kMost - before ? kMost : before + end;
}

// Layout: number of blocks, block size, size of the last block if smaller, compressed sizes, blocks.
std::string take_compressed(ByteSource& source, const VtuEncoding& encoding, const AdmitBytes& admit) {
  const std::uint64_t blocks = take_length(source, encoding);
  const std::uint64_t size = take_length(source, encoding);
  const std::uint64_t last = take_length(source, encoding);
  source.expect(blocks);  // each has a length field
  admit(sum_of_blocks(blocks, size, last));
  std::vector<std::uint64_t> compressed;
  for (std::uint64_t b = 0; b < blocks; ++b) compressed.push_back(take_length(source, encoding));
  std::string out;
  for (std::uint64_t b = 0; b < blocks; ++b)
    append_inflated(source.take(compressed[b]), b + 1 == blocks && last != 0 ? last : size, out);
  return out;
}

}  // namespace

void swap_bytes(std::string& bytes, std::size_t width) {
  for (std::size_t i = 0; i + width <= bytes.size(); i += width)
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                 bytes.begin() + static_cast<std::ptrdiff_t>(i + width));
}

std::string vtu_bytes(std::string_view text, const VtuEncoding& encoding, const AdmitBytes& admit) {
  ByteSource source(text, encoding.base64);
  if (encoding.zlib) return take_compressed(source, encoding, admit);
  const std::uint64_t length = take_length(source, encoding);
  source.expect(length);
  admit(length);
  return source.take(length);
}

}  // namespace orthodyn
