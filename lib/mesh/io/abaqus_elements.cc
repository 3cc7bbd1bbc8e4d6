#include "lib/mesh/io/abaqus_elements.h"

#include <algorithm>
#include <span>

#include "lib/mesh/split_cells.h"

namespace orthodyn {

void AbaqusElementReader::read(const AbaqusKeyword& keyword) {
  const std::string type = abaqus_word(keyword.parameter("TYPE"));
  const std::string set = keyword.parameter("ELSET");
  if (!set.empty()) sets_.touch(set, file_.element_sets);
  if (const auto shape = abaqus_shape(type)) {
    if (type.starts_with("C3D8R") || type.starts_with("C3D8I"))
      file_.draft.warn(
          lines_.place(),
          "elements of type {} are read as C3D8, with full integration: linear ones are too stiff in bending; "
          "`order: 2` makes them quadratic",
          type);
    if (type.starts_with("C3D27R"))
      file_.draft.warn(lines_.place(), "elements of type {} are read as C3D27, with full integration", type);
    while (!lines_.at_keyword()) read_element(*shape, type, set);
  } else if (type.empty() || type.find("3D") != std::string::npos) {
    // Names of trusses, rigid elements, membranes and connectors in space contain 3D, too.
    if (type.starts_with("T3D") || type.starts_with("R3D") || type.starts_with("M3D") || type.starts_with("CONN") ||
        type.starts_with("DCOUP"))
      return ignore(type, set);
    lines_.fail(
        "element type {} is not supported; supported solid elements: {}. Correct the type, or mesh again with these",
        type.empty() ? "(none given)" : type, abaqus_solids());
  } else {
    ignore(type, set);
  }
}

// Ignored elements still belong to sets. A line that ends with a comma continues on the next line.
void AbaqusElementReader::ignore(const std::string& type, const std::string& set) {
  bool continues = false;
  while (!lines_.at_keyword()) {
    const std::string_view rest = lines_.rest_of_line();
    const bool ends_with_comma = !rest.empty() && rest[rest.find_last_not_of(" \t\r")] == ',';
    const auto& fields = lines_.data();
    if (!continues && !fields.empty()) {
      const std::int64_t tag = scopes_.number(fields[0], "the number of an element");
      file_.ignored_elements.push_back({tag, lines_.place()});
      ++ignored_[type];
      if (!set.empty()) sets_.add(abaqus_number_member(tag, lines_.place()), set, file_.element_sets);
    }
    continues = ends_with_comma;
  }
}

// The list of nodes may continue on the next line.
void AbaqusElementReader::read_element(const AbaqusShape& shape, const std::string& type, const std::string& set) {
  const std::vector<std::string_view>* fields = &lines_.data();
  const FilePlace place = lines_.place();
  const std::int64_t tag = scopes_.number(fields->empty() ? "" : (*fields)[0], "the number of an element");
  const std::int64_t own = tag - scopes_.offset();
  nodes_.clear();
  for (std::size_t at = 1; nodes_.size() < shape.nodes || at < fields->size(); ++at) {
    if (at < fields->size()) {
      nodes_.push_back(scopes_.number((*fields)[at], "a node"));
      continue;
    }
    if (lines_.at_keyword())
      lines_.fail("element {} ends early: {} of the {} nodes of a {}; is the file truncated?", own, nodes_.size(),
                  shape.nodes, type);
    fields = &lines_.data();
    at = static_cast<std::size_t>(-1);
  }
  if (nodes_.size() > shape.nodes)
    lines_.fail("element {}: {} nodes, where a {} has {}; correct the type or the nodes", own, nodes_.size(), type,
                shape.nodes);
  scopes_.record_number(own);
  shape.solid ? add_cell(tag, shape, place) : add_face(tag, shape, place);
  if (!set.empty()) sets_.add(abaqus_number_member(tag, place), set, file_.element_sets);
}

void AbaqusElementReader::add_cell(std::int64_t tag, const AbaqusShape& shape, FilePlace place) {
  FileCell& cell = file_.draft.cells.emplace_back(FileCell{.tag = tag, .kind = *shape.solid, .place = place});
  const auto middles = nodes_.begin() + static_cast<std::ptrdiff_t>(shape.corners);
  std::copy(nodes_.begin(), middles, cell.nodes.begin());
  if (shape.nodes == shape.corners) return;
  if (cell.kind == CellKind::tet) {
    std::copy(middles, nodes_.end(), cell.midsides.emplace().begin());
    return;
  }
  const auto& edges = edges_of(cell.kind);
  cell.add_edge_middles(edges, std::span(nodes_).subspan(shape.corners));
  // After the mid-edge nodes C3D27 lists the node at the centre, then the nodes in the middle of the faces S1 to S6.
  // C3D15V lists the nodes in the middle of the faces S3 to S5.
  std::size_t next = shape.corners + edges.size();
  if (next == shape.nodes) return;
  if (cell.kind == CellKind::hexahedron) cell.add_centre(nodes_[next++]);
  for (const CornerIndices& face : faces_of(cell.kind))
    if (face.size() == 4) cell.add_face_middle({face[0], face[1], face[2], face[3]}, nodes_[next++]);
}

void AbaqusElementReader::add_face(std::int64_t tag, const AbaqusShape& shape, FilePlace place) {
  FileFace& face = file_.faces.emplace_back(FileFace{.tag = tag, .sides = shape.corners, .place = place});
  const auto middles = nodes_.begin() + static_cast<std::ptrdiff_t>(shape.corners);
  std::copy(nodes_.begin(), middles, face.nodes.begin());
  file_.face_middles.emplace_back(middles, nodes_.end());
}

}  // namespace orthodyn
