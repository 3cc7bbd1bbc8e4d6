#include "lib/config/registry.h"

namespace orthodyn {

std::vector<std::string>& registry_conflicts() {
  static std::vector<std::string> all;
  return all;
}

}  // namespace orthodyn
