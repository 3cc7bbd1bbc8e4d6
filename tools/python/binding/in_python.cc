#include "tools/python/binding/in_python.h"

#include <array>
#include <utility>

namespace orthodyn::python {

namespace {

// The longer ones first where one begins another.
constexpr std::array<std::pair<const char*, const char*>, 8> kWords{{{"--estimate-error", "estimate_error=True"},
                                                                     {"--force", "force=True"},
                                                                     {"--resume", "resume=True"},
                                                                     {"--retry", "retry=True"},
                                                                     {"--integrator", "with_integrator"},
                                                                     {"--jobs", "jobs"},
                                                                     {"--out", "out"},
                                                                     {"--set", "set"}}};

}  // namespace

std::string in_python(std::string message) {
  for (const auto& [option, argument] : kWords) {
    const std::string word = option;
    for (auto at = message.find(word); at != std::string::npos; at = message.find(word, at))
      message.replace(at, word.size(), argument);
  }
  return message;
}

}  // namespace orthodyn::python
