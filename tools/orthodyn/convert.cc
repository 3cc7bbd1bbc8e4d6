// `orthodyn convert`: a mesh from one format to another.
#include <fmt/format.h>

#include <filesystem>

#include "lib/core/errors.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "tools/orthodyn/commands.h"

namespace orthodyn {

int convert_command(const ConvertArguments& arguments) {
  if (!(arguments.scale > 0)) throw ConfigError(fmt::format("--scale {}: must be positive", arguments.scale));
  mesh_format_of(arguments.out);
  LoadedMesh loaded = read_mesh(arguments.in);
  if (arguments.scale != 1) scale_mesh(loaded.mesh, arguments.scale, arguments.in);
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}\n", warning);
  for (const std::string& loss : write_mesh(loaded, arguments.out, arguments.force)) {
    fmt::print(stderr, "{}: {}\n", arguments.out, loss);
  }
  fmt::print("{}: {} nodes, {} elements\n", arguments.out, loaded.mesh.nodes.size(), loaded.mesh.tets.size());
  return 0;
}

}  // namespace orthodyn
