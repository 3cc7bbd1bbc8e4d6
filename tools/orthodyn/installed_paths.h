// Files that come with the program: beside it where it is installed, else in the tree that it was built
// from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

// The tool that draws; it may be missing.
std::filesystem::path draw_tool();

// What starts it: itself, or the Python that the environment variable ORTHODYN_DRAW_PYTHON names, with it.
std::vector<std::string> draw_command();

// The JSON Schema of a kind of input; it may be missing.
std::filesystem::path schema_file(const std::string& kind);

}  // namespace orthodyn
