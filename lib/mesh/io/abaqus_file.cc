#include "lib/mesh/io/abaqus_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "lib/mesh/io/abaqus_types.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

std::string stripped(std::string_view text) {
  const auto is_edge = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_edge(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_edge(text.back())) text.remove_suffix(1);
  return std::string(text);
}

// The next comma that does not stand in quotes; a quote that nothing closes is a character like others.
std::size_t next_comma(std::string_view line) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == ',') return k;
    if (line[k] != '"') continue;
    const std::size_t close = line.find('"', k + 1);
    if (close == std::string_view::npos) return std::min(line.find(',', k), line.size());
    k = close;
  }
  return line.size();
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t comma = next_comma(line);
    fields.push_back(stripped(line.substr(0, comma)));
    if (comma == line.size()) return fields;
    line.remove_prefix(comma + 1);
  }
}

// "*ELEMENT, TYPE=C3D4, ELSET=body"
struct Keyword {
  std::string name = {};  // in capitals, without the star
  std::map<std::string, std::string> parameters = {};
  FilePlace place = {};

  std::string parameter(const std::string& key) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? "" : found->second;
  }
};

class AbaqusReader {
 public:
  AbaqusReader(const std::string& path, std::string_view text)
      : tokens_(path, text, {.commas = true, .comment = "**"}) {
    file_.draft.files = {path};
    file_.draft.nodes_section = "*NODE";
  }

  AbaqusFile read() {
    if (!tokens_.at_end() && tokens_.peek() != '*') {
      tokens_.fail(fmt::format("expected a keyword (*NODE), found {}; this is not an Abaqus input file (.inp)",
                               TextTokens::quoted(tokens_.word("a keyword"))));
    }
    while (!tokens_.at_end()) read_keyword(next_keyword());
    warn_of_skipped();
    return std::move(file_);
  }

 private:
  // A line that ends with a comma goes on in the next one.
  Keyword next_keyword() {
    Keyword keyword{.place = {tokens_.line()}};
    std::vector<std::string> fields = fields_of(tokens_.rest_of_line());
    tokens_.skip_line();
    while (fields.size() > 1 && fields.back().empty() && !at_keyword()) {
      fields.pop_back();
      for (std::string& field : fields_of(tokens_.rest_of_line())) fields.push_back(std::move(field));
      tokens_.skip_line();
    }
    keyword.name = in_capitals(stripped(std::string_view(fields[0]).substr(1)));
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const std::size_t equals = std::min(fields[k].find('='), fields[k].size());
      const std::string value =
          equals < fields[k].size() ? stripped(std::string_view(fields[k]).substr(equals + 1)) : "";
      keyword.parameters[in_capitals(stripped(std::string_view(fields[k]).substr(0, equals)))] = value;
    }
    return keyword;
  }

  bool at_keyword() { return tokens_.at_end() || tokens_.peek() == '*'; }

  void read_keyword(const Keyword& keyword) {
    const std::string& name = keyword.name;
    if (name == "NODE") return read_nodes(keyword);
    if (name == "ELEMENT") return read_elements(keyword);
    if (name == "NSET") return read_set(keyword, "NSET", file_.node_sets);
    if (name == "ELSET") return read_set(keyword, "ELSET", file_.element_sets);
    if (name == "SURFACE") return read_surface(keyword);
    if (name == "SOLID SECTION") {
      file_.sections.push_back({{.set = set_name(keyword.parameter("ELSET")), .place = keyword.place},
                                set_name(keyword.parameter("ORIENTATION"))});
      return skip_data();
    }
    if (name == "ORIENTATION") return read_orientation(keyword);
    if (name == "PART" || name == "INSTANCE") return read_part(keyword);
    if (name == "END PART" || name == "END INSTANCE" || name == "ASSEMBLY" || name == "END ASSEMBLY" ||
        name == "HEADING" || name == "PREPRINT") {
      return skip_data();
    }
    refuse_what_makes_nodes(keyword);
    skipped_.insert("*" + name);
    skip_data();
  }

  void refuse_what_makes_nodes(const Keyword& keyword) const {
    if (keyword.name == "INCLUDE") {
      file_.draft.fail(keyword.place, "*INCLUDE is not read; put the included lines in its place");
    }
    for (const char* name : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "SUBMODEL"}) {
      if (keyword.name == name) {
        file_.draft.fail(
            keyword.place,
            fmt::format("*{} is not read; write the nodes and elements themselves, in global coordinates", name));
      }
    }
  }

  void read_part(const Keyword& keyword) {
    if (++parts_[keyword.name] > 1) {
      file_.draft.fail(keyword.place,
                       fmt::format("a second *{}; only one is read: write the model without parts and assemblies "
                                   "(Abaqus/CAE: Model attributes, \"Do not use parts and assemblies in input files\")",
                                   keyword.name));
    }
    if (keyword.name == "INSTANCE" && !at_keyword()) {
      tokens_.fail("an instance that is moved; write the nodes in global coordinates, without parts and assemblies");
    }
    skip_data();
  }

  void skip_data() {
    while (!at_keyword()) tokens_.skip_line();
  }

  void read_nodes(const Keyword& keyword) {
    const std::string set = keyword.parameter("NSET");
    while (!at_keyword()) {
      FileNode node;
      node.place.line = tokens_.line();
      node.tag = tokens_.integer("the number of a node");
      for (double& x : node.x) x = tokens_.real("a coordinate");
      tokens_.skip_line();  // direction cosines may follow
      file_.draft.nodes.push_back(node);
      if (!set.empty()) add({node.tag, node.tag, 1, "", node.place}, set, file_.node_sets);
    }
  }

  void read_elements(const Keyword& keyword) {
    const std::string type = in_capitals(keyword.parameter("TYPE"));
    const std::string set = keyword.parameter("ELSET");
    if (const auto shape = abaqus_shape(type)) {
      while (!at_keyword()) read_element(*shape, set);
    } else if (type.empty() || type.find("3D") != std::string::npos) {
      // Trusses and beams in space have 3D in their names, too.
      if (type.starts_with("T3D") || type.starts_with("R3D") || type.starts_with("M3D")) return ignore(type);
      file_.draft.fail(
          keyword.place,
          fmt::format(
              "elements of type {}; solid elements that are read: {}. Correct the type, or mesh again with these",
              type.empty() ? "(none given)" : type, abaqus_solids()));
    } else {
      ignore(type);
    }
  }

  void ignore(const std::string& type) {
    skipped_.insert("elements " + TextTokens::quoted(type));
    skip_data();
  }

  // The nodes may go on in the next line.
  void read_nodes_of(std::int64_t element, auto&& nodes) {
    for (std::int64_t& node : nodes) {
      if (tokens_.peek() == '\0') tokens_.skip_line();
      if (at_keyword()) tokens_.fail(fmt::format("element {} ends early; is the file truncated?", element));
      node = tokens_.integer("a node");
    }
  }

  void read_element(const AbaqusShape& shape, const std::string& set) {
    const FilePlace place{tokens_.line()};
    const std::int64_t tag = tokens_.integer("the number of an element");
    if (shape.solid) {
      FileCell& cell = file_.draft.cells.emplace_back(FileCell{.tag = tag, .kind = *shape.solid, .place = place});
      read_nodes_of(tag, cell.corners());
      if (shape.nodes > shape.corners && cell.kind == CellKind::tet) read_nodes_of(tag, cell.midsides.emplace());
      else if (shape.nodes > shape.corners) read_edges_of(cell, shape);
    } else {
      FileFace& face = file_.faces.emplace_back(FileFace{.tag = tag, .sides = shape.corners, .place = place});
      read_nodes_of(tag, face.corners());
      skip_nodes_of(tag, shape);  // those of the element behind
    }
    tokens_.finish_line();
    if (!set.empty()) add({tag, tag, 1, "", place}, set, file_.element_sets);
  }

  // Nodes beyond those of the edges lie within faces, or within the element.
  void read_edges_of(FileCell& cell, const AbaqusShape& shape) {
    std::vector<std::int64_t> middles(shape.nodes - shape.corners);
    read_nodes_of(cell.tag, middles);
    const auto& edges = edges_of(cell.kind);
    for (std::size_t e = 0; e < edges.size(); ++e)
      cell.edges.push_back({cell.nodes[edges[e][0]], cell.nodes[edges[e][1]], middles[e]});
  }

  void skip_nodes_of(std::int64_t element, const AbaqusShape& shape) {
    std::vector<std::int64_t> others(shape.nodes - shape.corners);
    read_nodes_of(element, others);
  }

  // Names of an instance's sets carry its name: "PART-1-1.SIDE".
  static std::string set_name(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return in_capitals(dot == std::string::npos ? name : name.substr(dot + 1));
  }

  void add(AbaqusMembers members, const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set = sets.try_emplace(in_capitals(name), AbaqusSet{name, {}, 0}).first->second;
    set.order = ++order_;
    // Consecutive numbers of one keyword need no more room than a range.
    if (!set.members.empty() && members.set.empty()) {
      AbaqusMembers& last = set.members.back();
      if (last.set.empty() && last.step == 1 && members.step == 1 && members.first == members.last &&
          members.first > last.last && members.first - 1 == last.last) {
        last.last = members.last;
        return;
      }
    }
    set.members.push_back(std::move(members));
  }

  void read_set(const Keyword& keyword, const char* parameter, AbaqusSets& sets) {
    const std::string name = keyword.parameter(parameter);
    if (name.empty()) file_.draft.fail(keyword.place, fmt::format("*{} without {}=name", keyword.name, parameter));
    sets.try_emplace(in_capitals(name), AbaqusSet{name, {}, ++order_});
    const bool generate = keyword.parameters.contains("GENERATE");
    while (!at_keyword()) {
      if (generate) {
        add(read_range(), name, sets);
        tokens_.finish_line();
        continue;
      }
      while (tokens_.peek() != '\0') add(read_member(), name, sets);
      tokens_.skip_line();
    }
  }

  AbaqusMembers read_range() {
    AbaqusMembers range{.place = {tokens_.line()}};
    range.first = tokens_.integer("the first number");
    range.last = tokens_.integer("the last number");
    if (tokens_.peek() != '\0') range.step = tokens_.integer("the increment");
    if (range.step == 0 && range.first == range.last) range.step = 1;
    if (range.step < 1 || range.first < 0 || range.last < range.first) {
      tokens_.fail(fmt::format("from {} to {} by {}; the numbers must ascend", range.first, range.last, range.step));
    }
    return range;
  }

  AbaqusMembers read_member() {
    AbaqusMembers member{.place = {tokens_.line()}};
    const char first = tokens_.peek();
    if (std::isdigit(static_cast<unsigned char>(first)) || first == '-' || first == '+') {
      member.first = member.last = tokens_.integer("a number");
    } else {
      member.set = set_name(stripped(tokens_.word("a set")));
    }
    return member;
  }

  void read_surface(const Keyword& keyword) {
    const std::string name = keyword.parameter("NAME");
    const std::string type = in_capitals(keyword.parameter("TYPE"));
    if (name.empty()) file_.draft.fail(keyword.place, "*SURFACE without NAME=name");
    if (!type.empty() && type != "ELEMENT") {
      skipped_.insert("*SURFACE of type " + TextTokens::quoted(type));
      return skip_data();
    }
    AbaqusSurface& surface = file_.surfaces.try_emplace(in_capitals(name), AbaqusSurface{name, {}}).first->second;
    while (!at_keyword()) {
      AbaqusFace face{.elements = read_member()};
      if (tokens_.peek() == '\0') tokens_.fail("a surface of elements without a face; give S1, S2, ...");
      const std::string side = in_capitals(std::string(tokens_.word("a face")));
      if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6') {
        tokens_.fail(fmt::format("face {}; expected S1 to S4 of a tetrahedron, to S5 of a wedge or pyramid, to S6 of a "
                                 "hexahedron", TextTokens::quoted(side)));
      }
      face.side = static_cast<std::size_t>(side[1] - '1');
      tokens_.finish_line();
      surface.faces.push_back(std::move(face));
    }
  }

  // Two points, and if wanted the origin: axis 1 points to the first one, the second is in the plane of axes 1 and 2.
  // The next line may turn them about one of them, in degrees.
  void read_orientation(const Keyword& keyword) {
    const std::string name = keyword.parameter("NAME");
    if (name.empty()) file_.draft.fail(keyword.place, "*ORIENTATION without NAME=name");
    AbaqusOrientation orientation{name, {}, keyword.place};
    const auto is = [&](const char* key, const char* value) {
      const std::string given = in_capitals(keyword.parameter(key));
      return given.empty() || given == value;
    };
    if (is("SYSTEM", "RECTANGULAR") && is("DEFINITION", "COORDINATES") && !at_keyword())
      orientation.axes = turned(axes_through_points(keyword));
    skip_data();
    file_.orientations[in_capitals(name)] = std::move(orientation);
  }

  Mat3 axes_through_points(const Keyword& keyword) {
    std::vector<double> numbers;
    while (tokens_.peek() != '\0') numbers.push_back(tokens_.real("a coordinate"));
    tokens_.skip_line();
    if (numbers.size() != 6 && numbers.size() != 9)
      file_.draft.fail(keyword.place, fmt::format("*ORIENTATION with {} coordinates; expected two points, or three",
                                                  numbers.size()));
    numbers.resize(9, 0);
    const Eigen::Map<const Mat3> points(numbers.data());
    const Vec3 first = points.col(0) - points.col(2), third = first.cross(points.col(1) - points.col(2));
    if (!(third.norm() > 1e-12 * points.squaredNorm()))
      file_.draft.fail(keyword.place, "*ORIENTATION whose points are on a line; give two different directions");
    Mat3 Q;
    Q << first.normalized(), third.cross(first).normalized(), third.normalized();
    return Q;
  }

  Mat3 turned(const Mat3& Q) {
    if (at_keyword()) return Q;
    const std::int64_t axis = tokens_.integer("the axis to turn about");
    const double degrees = tokens_.peek() == '\0' ? 0 : tokens_.real("an angle in degrees");
    if (axis < 1 || axis > 3) tokens_.fail(fmt::format("axis {} of *ORIENTATION; expected 1, 2 or 3", axis));
    return Q * Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::Unit(axis - 1)).toRotationMatrix();
  }

  void warn_of_skipped() {
    if (skipped_.empty()) return;
    std::string all;
    for (const std::string& what : skipped_) all += (all.empty() ? "" : ", ") + what;
    file_.draft.warnings.push_back(fmt::format("{}: only the mesh is read; skipped: {}", tokens_.path(), all));
  }

  TextTokens tokens_;
  AbaqusFile file_;
  std::map<std::string, int> parts_;
  std::set<std::string> skipped_;
  int order_ = 0;
};

}  // namespace

AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text) {
  return AbaqusReader(path, text).read();
}

}  // namespace orthodyn
