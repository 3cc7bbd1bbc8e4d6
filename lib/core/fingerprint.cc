#include "lib/core/fingerprint.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "lib/core/errors.h"

namespace orthodyn {

Fingerprint& Fingerprint::add(const std::string& text) {
  const auto mix = [this](const std::string& part) {
    for (const char c : part) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  };
  mix(fmt::format("{}:", text.size()));
  mix(text);
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
