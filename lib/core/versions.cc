#include "lib/core/versions.h"

namespace orthodyn {

std::string orthodyn_version() { return ORTHODYN_VERSION; }

std::map<std::string, std::string>& library_versions() {
  static std::map<std::string, std::string> versions;
  return versions;
}

}  // namespace orthodyn
