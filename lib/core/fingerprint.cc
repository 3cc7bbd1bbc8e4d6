#include "lib/core/fingerprint.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "lib/core/errors.h"

namespace orthodyn {

Fingerprint& Fingerprint::add(const std::string& text) {
  return add_piece(fmt::format("{}:", text.size())).add_piece(text);
}

Fingerprint& Fingerprint::add_piece(std::string_view piece) {
  for (const char c : piece) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return *this;
}

Fingerprint& Fingerprint::add_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  if (!in) throw RunError(path.string() + ": cannot be read");
  return add(content.str());
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", hash_); }

}  // namespace orthodyn
