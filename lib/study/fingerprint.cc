#include "lib/study/fingerprint.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "lib/core/errors.h"
#include "lib/core/versions.h"
#include "lib/linear/blas.h"
#include "lib/study/machine.h"

namespace orthodyn {

Fingerprint& Fingerprint::add(const std::string& text) {
  const std::string sized = fmt::format("{}:{}", text.size(), text);
  for (const char c : sized) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3;
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

std::string code_fingerprint() {
  Fingerprint print;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&code_fingerprint), &info) != 0 && info.dli_fname)
    print.add_file(info.dli_fname);
  print.add(orthodyn_version()).add(blas_name());
  for (const auto& [library, version] : library_versions()) print.add(library + " " + version);
  return print.text();
}

std::string machine_fingerprint() {
  Fingerprint print;
  print.add(machine_json().dump());
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) {
    const char* value = std::getenv(variable);
    print.add(value ? value : "");
  }
  return print.text();
}

}  // namespace orthodyn
