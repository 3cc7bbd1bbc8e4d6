// Binary Gmsh files of formats 2.2 and 4.1 as what they are in ASCII.
#pragma once

#include <string>
#include <string_view>

namespace orthodyn {

// Whether the line behind $MeshFormat says that the file is binary.
bool is_binary_gmsh(std::string_view text);

// The same file in ASCII. Sections that are not read are left out. Of this machine's byte order only. Throws
// ConfigError "file: byte N of ...: found, remedy" for one that ends early or announces more than it holds.
// Precondition: is_binary_gmsh().
std::string ascii_of_binary_gmsh(const std::string& path, std::string_view bytes);

}  // namespace orthodyn
