// Small Gmsh files for the tests of the reader: two tets that share a face, in both formats.
#pragma once

#include <stdlib.h>  // mkdtemp

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/mesh/refusal.h"

namespace orthodyn {

// A file in its own directory; the destructor removes both.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    std::string name = (std::filesystem::temp_directory_path() / "gmsh_test_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    directory_ = name;
    write(content);
  }
  ~TemporaryFile() { std::filesystem::remove_all(directory_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::string& content) const { std::ofstream(path(), std::ios::binary) << content; }
  std::string path() const { return (directory_ / "beam.msh").string(); }

 private:
  std::filesystem::path directory_;
};

inline const std::string kFile22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 5 "load"
3 1 "left"
3 2 "right side"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
5
1 15 2 0 1 1
2 1 2 0 1 1 2
3 2 2 5 1 1 3 2
4 4 2 1 1 1 2 3 4
5 4 2 2 2 2 3 4 5
$EndElements
)";

inline const std::string kFile41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
2 5 "load"
3 1 "left"
3 2 "right side"
$EndPhysicalNames
$Entities
1 1 1 2
1 0 0 0 0
1 0 0 0 1 0 0 0 2 1 -1
1 0 0 0 1 1 0 1 5 1 1
1 0 0 0 1 1 1 1 1 1 1
2 0 0 0 1 1 1 1 2 0
$EndEntities
$Nodes
2 5 1 5
0 1 0 1
1
0 0 0
3 1 0 4
2
3
4
5
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
5 5 1 5
0 1 15 1
1 1
1 1 1 1
2 1 2
2 1 2 1
3 1 3 2
3 1 4 1
4 1 2 3 4
3 2 4 1
5 2 3 4 5
$EndElements
)";

}  // namespace orthodyn
