// Reads Gmsh format 2: nodes "tag x y z", elements "tag type ntags physical ... nodes".

#include "lib/mesh/io/gmsh_file.h"

namespace orthodyn {
namespace {

void read_nodes(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  const std::int64_t announced = tokens.count("the number of nodes");
  tokens.finish_line();
  for (std::int64_t i = 0; i < announced; ++i) {
    expect_record(tokens, section, i, announced, "nodes");
    FileNode node;
    node.place.line = tokens.line();
    node.tag = tokens.integer("a node tag");
    for (double& x : node.x) x = tokens.real("a coordinate");
    tokens.finish_line();
    file.nodes.push_back(node);
  }
  end_section(tokens, section);
}

// The first tag is the physical group, 0 for none; the others (entity, partitions) are ignored.
int read_groups(TextTokens& tokens, GmshFile& file) {
  const std::int64_t tags = tokens.count("the number of element tags");
  int groups = 0;
  for (std::int64_t i = 0; i < tags; ++i) {
    if (i > 0) {
      tokens.integer("an element tag");
    } else if (const int physical = read_tag(tokens, "a physical tag"); physical != 0) {
      groups = intern_groups(file, {physical});
    }
  }
  return groups;
}

void read_elements(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  const std::int64_t announced = tokens.count("the number of elements");
  tokens.finish_line();
  for (std::int64_t i = 0; i < announced; ++i) {
    expect_record(tokens, section, i, announced, "elements");
    const std::int64_t tag = tokens.integer("an element tag");
    const GmshType type = check_element_type(tokens, tokens.integer("an element type"));
    read_element_nodes(tokens, type, tag, read_groups(tokens, file), file);
  }
  end_section(tokens, section);
}

void refuse_parametric(TextTokens& tokens, const GmshSection& section, GmshFile&) {
  tokens.fail_at(section.line, "$ParametricNodes is not supported; save with Mesh.SaveParametric = 0");
}

}  // namespace

GmshSectionReaders gmsh_v2_sections() {
  return {{"Nodes", read_nodes}, {"Elements", read_elements}, {"ParametricNodes", refuse_parametric}};
}

}  // namespace orthodyn
