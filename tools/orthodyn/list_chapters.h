// The chapters of `orthodyn list`.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace orthodyn {

// Each chapter's name and a function that prints it to stdout, in the order of printing.
const std::vector<std::pair<std::string, std::function<void()>>>& list_chapters();

}  // namespace orthodyn
