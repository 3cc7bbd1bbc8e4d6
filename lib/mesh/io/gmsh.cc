#include "lib/mesh/io/gmsh.h"

#include "lib/mesh/io/gmsh_build.h"
#include "lib/mesh/io/gmsh_file.h"
#include "lib/mesh/io/text_file.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {

LoadedMesh read_gmsh(const std::string& path) { return read_gmsh_text(path, read_text_file(path)); }

LoadedMesh read_gmsh_text(const std::string& path, std::string_view text) {
  TextTokens tokens(path, text);
  GmshFile file = read_gmsh_sections(tokens);
  return build_gmsh_mesh(file, tokens);
}

}  // namespace orthodyn
