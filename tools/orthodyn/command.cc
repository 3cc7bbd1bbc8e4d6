#include "tools/orthodyn/command.h"

#include <algorithm>

namespace orthodyn {

namespace {

// Made at its first use: the order in which files register is not defined.
std::vector<Command>& registered() {
  static std::vector<Command> all;
  return all;
}

}  // namespace

std::vector<Command> commands() {
  auto all = registered();
  std::sort(all.begin(), all.end(), [](const Command& a, const Command& b) { return a.text.order < b.text.order; });
  return all;
}

void CommandRegistration::add(Command command) { registered().push_back(std::move(command)); }

}  // namespace orthodyn
