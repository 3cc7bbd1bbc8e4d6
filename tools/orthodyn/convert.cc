// `orthodyn convert`: converts a mesh to another file format.
#include <fmt/format.h>

#include <filesystem>

#include "lib/core/errors.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "tools/orthodyn/command.h"

namespace orthodyn {

namespace {

struct ConvertArguments {
  std::string in, out;
  double scale = 1;
  bool split = false, force = false;
};

int convert(const ConvertArguments& arguments) {
  if (!(arguments.scale > 0)) throw ConfigError(fmt::format("--scale: must be positive, found {}", arguments.scale));
  mesh_format_to_write(arguments.out);
  LoadedMesh loaded = read_mesh(arguments.in, arguments.split ? FileCells::split : FileCells::keep);
  if (arguments.scale != 1) scale_mesh(loaded.mesh, arguments.scale, arguments.in);
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}\n", warning);
  for (const std::string& loss : write_mesh(loaded, arguments.out, arguments.force)) {
    fmt::print(stderr, "{}: {}\n", arguments.out, loss);
  }
  fmt::print("{}: {} nodes, {}\n", arguments.out, loaded.mesh.nodes.size(), describe_cells(loaded.mesh.cells));
  return 0;
}

void declare(ConvertArguments& arguments, CommandOptions& options) {
  options.value("in", arguments.in, "The mesh to read: " + known_mesh_endings() + ".").required().type("IN");
  options.value("out", arguments.out, "The mesh to write. Data that its format cannot hold is reported.")
      .required()
      .type("OUT");
  options.value("--scale", arguments.scale, "Multiply coordinates by this factor, e.g. 0.001 for a mesh in mm.")
      .type("FACTOR");
  options.flag("--split", arguments.split, "Make tetrahedra of hexahedra and wedges.");
  options.flag("--force", arguments.force, "Replace existing files.");
}

const CommandRegistration convert_command(
    {.order = 80,
     .name = "convert",
     .sentence = "Convert a mesh to another format, chosen by the ending of the file name.",
     .examples = R"(
  orthodyn convert part.msh part.vtu
  orthodyn convert part.inp part.msh --scale 0.001)"},
    declare, convert);

}  // namespace

}  // namespace orthodyn
