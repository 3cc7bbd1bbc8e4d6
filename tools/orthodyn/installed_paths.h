// Paths of files that belong to the program: in the installation, else in the source tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

// The drawing tool; may not exist.
std::filesystem::path draw_tool();

// Command that starts the drawing tool, with the Python of the environment variable ORTHODYN_DRAW_PYTHON if set.
std::vector<std::string> draw_command();

// JSON Schema of a kind of input ("scene"); may not exist.
std::filesystem::path schema_file(const std::string& kind);

}  // namespace orthodyn
