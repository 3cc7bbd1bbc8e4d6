#include "tools/python/binding/in_python.h"

#include <cctype>
#include <string_view>
#include <utility>

namespace orthodyn::python {

namespace {

constexpr std::pair<const char*, const char*> kWords[] = {{"--estimate-error", "estimate_error=True"},
                                                          {"--force", "force=True"},
                                                          {"--resume", "resume=True"},
                                                          {"--retry", "retry=True"},
                                                          {"--integrator", "with_integrator"},
                                                          {"--jobs", "jobs"},
                                                          {"--out", "out"},
                                                          {"--set", "set"}};

bool is_part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '/'; }

}  // namespace

std::string in_python(std::string message) {
  for (const auto& [option, argument] : kWords) {
    const std::string_view word = option;
    for (auto at = message.find(word); at != std::string::npos; at = message.find(word, at + 1)) {
      const auto after = at + word.size();
      if (at > 0 && is_part_of_word(message[at - 1])) continue;
      if (after < message.size() && is_part_of_word(message[after])) continue;
      message.replace(at, word.size(), argument);
    }
  }
  return message;
}

}  // namespace orthodyn::python
