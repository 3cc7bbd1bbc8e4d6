// Reads Gmsh format 4.1: nodes and elements in blocks, one per model entity. Physical groups belong to the entities.

#include <array>
#include <vector>

#include "lib/mesh/io/gmsh_file.h"

namespace orthodyn {
namespace {

int read_dimension(TextTokens& tokens) {
  const std::int64_t dim = tokens.integer("the dimension of an entity");
  if (dim < 0 || dim > 3) tokens.fail("dimension {}; expected 0 to 3", dim);
  return static_cast<int>(dim);
}

void read_entity(TextTokens& tokens, int dim, GmshFile& file) {
  const int tag = read_tag(tokens, "the tag of an entity");
  const int coordinates = dim == 0 ? 3 : 6;                           // of a point or a bounding box
  for (int i = 0; i < coordinates; ++i) tokens.word("a coordinate");  // infinite for an empty entity
  const std::int64_t count = tokens.count("the number of physical groups");
  std::vector<int> groups;
  for (std::int64_t i = 0; i < count; ++i) groups.push_back(read_tag(tokens, "a physical tag"));
  if (!file.entity_groups.emplace(GmshFile::DimTag(dim, tag), intern_groups(file, groups)).second)
    tokens.fail("entity {} of dimension {} is listed twice", tag, dim);
  tokens.skip_line();  // bounding entities
}

void read_entities(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  if (file.section_lines.contains("Elements")) tokens.fail_at(section.line, "$Entities must come before $Elements");
  std::array<std::int64_t, 4> announced{};
  for (std::int64_t& count : announced) count = tokens.count("the number of entities");
  tokens.finish_line();
  for (int dim = 0; dim < 4; ++dim) {
    const std::int64_t count = announced[static_cast<std::size_t>(dim)];
    for (std::int64_t i = 0; i < count; ++i) {
      expect_record(tokens, section, i, count, "entities");
      read_entity(tokens, dim, file);
    }
  }
  end_section(tokens, section);
}

// "blocks records lowest-tag highest-tag"
struct Totals {
  std::int64_t blocks, records;
};

Totals read_totals(TextTokens& tokens) {
  Totals totals{};
  totals.blocks = tokens.count("the number of blocks");
  totals.records = tokens.count("the number of records");
  tokens.integer("the lowest tag");
  tokens.integer("the highest tag");
  tokens.finish_line();
  return totals;
}

void check_total(const TextTokens& tokens, const GmshSection& section, std::int64_t announced, std::size_t found,
                 const char* records) {
  if (static_cast<std::size_t>(announced) == found) return;
  tokens.fail_at(section.line, "${} announces {} {}, but its blocks hold {}", section.name, announced, records, found);
}

// All tags of a block come first, one per line, then all coordinates.
void read_node_block(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  const int dim = read_dimension(tokens);
  tokens.integer("the tag of an entity");
  const std::int64_t parametric = tokens.integer("0 or 1 (parametric coordinates)");
  const std::int64_t count = tokens.count("the number of nodes");
  tokens.finish_line();
  const std::size_t first = file.nodes.size();
  for (std::int64_t i = 0; i < count; ++i) {
    expect_record(tokens, section, i, count, "node tags");
    file.nodes.emplace_back();
    file.nodes.back().tag = tokens.integer("a node tag");
    tokens.finish_line();
  }
  for (std::size_t n = first; n < file.nodes.size(); ++n) {
    expect_record(tokens, section, static_cast<std::int64_t>(n - first), count, "coordinates");
    file.nodes[n].place.line = tokens.line();
    for (double& x : file.nodes[n].x) x = tokens.real("a coordinate");
    for (int i = 0; parametric != 0 && i < dim; ++i) tokens.real("a parametric coordinate");
    tokens.finish_line();
  }
}

void read_node_blocks(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  const Totals totals = read_totals(tokens);
  for (std::int64_t b = 0; b < totals.blocks; ++b) {
    expect_record(tokens, section, b, totals.blocks, "blocks");
    read_node_block(tokens, section, file);
  }
  check_total(tokens, section, totals.records, file.nodes.size(), "nodes");
  end_section(tokens, section);
}

int groups_of_entity(const TextTokens& tokens, const GmshFile& file, int dim, int tag) {
  if (!file.section_lines.contains("Entities")) return 0;
  const auto entity = file.entity_groups.find({dim, tag});
  if (entity == file.entity_groups.end()) tokens.fail("entity {} of dimension {} is not in $Entities", tag, dim);
  return entity->second;
}

std::int64_t read_element_block(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  const int dim = read_dimension(tokens);
  const int entity = read_tag(tokens, "the tag of an entity");
  const GmshType type = check_element_type(tokens, tokens.integer("an element type"));
  using enum GmshType::Role;
  if ((type.role == face && dim != 2) || (type.role == cell && dim != 3)) {
    const char* faces = type.corners == 3 ? "triangles" : "quadrangles";
    tokens.fail("{} in an entity of dimension {}", type.role == cell ? name_of(type.kind, 2) : faces, dim);
  }
  const std::int64_t count = tokens.count("the number of elements");
  const int groups = groups_of_entity(tokens, file, dim, entity);
  tokens.finish_line();
  for (std::int64_t i = 0; i < count; ++i) {
    expect_record(tokens, section, i, count, "elements");
    const std::int64_t tag = tokens.integer("an element tag");
    read_element_nodes(tokens, type, tag, groups, file);
  }
  return count;
}

void read_element_blocks(TextTokens& tokens, const GmshSection& section, GmshFile& file) {
  const Totals totals = read_totals(tokens);
  std::size_t found = 0;
  for (std::int64_t b = 0; b < totals.blocks; ++b) {
    expect_record(tokens, section, b, totals.blocks, "blocks");
    found += static_cast<std::size_t>(read_element_block(tokens, section, file));
  }
  check_total(tokens, section, totals.records, found, "elements");
  end_section(tokens, section);
}

void refuse_partitions(TextTokens& tokens, const GmshSection& section, GmshFile&) {
  tokens.fail_at(section.line,
                 "a partitioned mesh ($PartitionedEntities); mesh again without -part, or open it in Gmsh, choose Mesh "
                 "> Unpartition, and save");
}

}  // namespace

GmshSectionReaders gmsh_v4_sections() {
  return {{"Entities", read_entities},
          {"PartitionedEntities", refuse_partitions},
          {"Nodes", read_node_blocks},
          {"Elements", read_element_blocks}};
}

}  // namespace orthodyn
