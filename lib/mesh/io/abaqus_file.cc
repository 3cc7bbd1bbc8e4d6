#include "lib/mesh/io/abaqus_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus_history.h"
#include "lib/mesh/io/abaqus_lines.h"
#include "lib/mesh/io/abaqus_orientations.h"
#include "lib/mesh/io/abaqus_scopes.h"
#include "lib/mesh/io/abaqus_sets.h"
#include "lib/mesh/io/abaqus_types.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class AbaqusReader {
 public:
  AbaqusReader(const std::string& path, std::string_view text) : file_(draft_of(path)), lines_(file_.draft, text) {}

  AbaqusFile read() {
    if (!lines_.at_keyword()) {
      lines_.fail(fmt::format("expected a keyword (*NODE), found {}; this is not an Abaqus input file (.inp)",
                              TextTokens::quoted(lines_.data()[0])));
    }
    read_until("");
    place_single_part();
    name_sets();
    refuse_circles_of_sets(file_);
    warn();
    return std::move(file_);
  }

 private:
  static AbaqusFile draft_of(const std::string& path) {
    AbaqusFile file;
    file.draft.files = {path};
    file.draft.nodes_section = "*NODE";
    return file;
  }

  // Up to a keyword or the end.
  void read_until(const std::string& last) {
    while (lines_.at_keyword() && !lines_.at_end()) {
      const AbaqusKeyword keyword = lines_.keyword();
      if (keyword.name == last) return lines_.skip_data();
      read_keyword(keyword);
    }
  }

  void read_keyword(const AbaqusKeyword& keyword) {
    const std::string& name = keyword.name;
    if (materials_.read(keyword) || orientations_.read(keyword)) return;
    if (name == "NODE") return read_nodes(keyword);
    if (name == "ELEMENT") return read_elements(keyword);
    if (name == "NSET") return read_set(keyword, "NSET", file_.node_sets);
    if (name == "ELSET") return read_set(keyword, "ELSET", file_.element_sets);
    if (name == "SURFACE") return read_surface(keyword);
    if (name == "SOLIDSECTION") return read_section(keyword);
    if (name == "PART") return note_part(keyword);
    if (name == "INSTANCE") return place_instance(keyword);
    if (name == "ASSEMBLY" || name == "ENDASSEMBLY" || name == "ENDPART" || name == "ENDINSTANCE" ||
        name == "HEADING" || name == "PREPRINT")
      return lines_.skip_data();
    refuse_what_makes_nodes(keyword);
    skip(keyword.spelled);
    history_.read(keyword);
    lines_.skip_data();
  }

  void skip(const std::string& what) { file_.skipped.try_emplace(what, lines_.place()); }

  void refuse_what_makes_nodes(const AbaqusKeyword& keyword) const {
    for (const char* name : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "SUBMODEL", "IMPORT",
                             "SYMMETRICMODELGENERATION"}) {
      if (keyword.name != name) continue;
      lines_.fail(fmt::format("{} is not read; write the nodes and elements themselves, in global coordinates",
                              keyword.spelled));
    }
  }

  void note_part(const AbaqusKeyword& keyword) {
    lines_.skip_data();
    const std::string name = lines_.name_of(keyword);
    const auto [part, is_new] = parts_.emplace(in_capitals(name), Part{name, lines_.mark()});
    if (!is_new) lines_.fail(fmt::format("a second *PART {}", TextTokens::quoted(part->second.name)));
    while (lines_.at_keyword() && !lines_.at_end()) {
      const std::string next = lines_.keyword().name;
      lines_.skip_data();
      if (next == "ENDPART") return;
    }
  }

  // The part is read once for each of its instances.
  void place_instance(const AbaqusKeyword& keyword) {
    const std::string name = lines_.name_of(keyword), part = lines_.name_of(keyword, "PART");
    const auto found = parts_.find(in_capitals(part));
    if (found == parts_.end()) lines_.fail(fmt::format("*INSTANCE: no *PART {}", TextTokens::quoted(part)));
    scopes_.enter(name);
    found->second.is_placed = true;
    lines_.enter(found->second.mark);
    read_until("ENDPART");
    lines_.leave();
    read_until("ENDINSTANCE");
    scopes_.leave();
  }

  // Without instances, a single part is the model.
  void place_single_part() {
    if (scopes_.instances().empty() && parts_.size() == 1) {
      lines_.enter(parts_.begin()->second.mark);
      read_until("ENDPART");
      lines_.leave();
    } else if (scopes_.instances().empty() && parts_.size() > 1) {
      lines_.fail(fmt::format("{} parts, and no *INSTANCE that places them", parts_.size()));
    } else {
      for (const auto& [key, part] : parts_)
        if (!part.is_placed) skip("*PART " + TextTokens::quoted(part.name) + ", which no *INSTANCE places");
    }
  }

  void read_nodes(const AbaqusKeyword& keyword) {
    const std::string set = keyword.parameter("NSET");
    const std::string system = lines_.choice(keyword, "SYSTEM", {"RECTANGULAR", "CYLINDRICAL", "SPHERICAL"});
    while (!lines_.at_keyword()) {
      const auto& fields = lines_.data();
      FileNode node{.place = lines_.place()};
      node.tag = scopes_.number(fields.empty() ? "" : fields[0], "the number of a node");
      if (fields.size() > 7)  // coordinates and direction cosines
        lines_.fail(fmt::format("{} numbers behind the number of a node; it has three coordinates", fields.size() - 1));
      Vec3 x;
      for (std::size_t k = 0; k < 3; ++k) x[static_cast<Eigen::Index>(k)] = lines_.real(k + 1, "a coordinate");
      node.x = scopes_.now().placement(cartesian(x, system[0]));
      scopes_.note(node.tag - scopes_.offset());
      file_.draft.nodes.push_back(node);
      if (!set.empty()) add(abaqus_number_member(node.tag, node.place), set, file_.node_sets);
    }
  }

  // Angles in degrees; of a sphere the second goes up from the plane x-y.
  static Vec3 cartesian(const Vec3& x, char system) {
    if (system == 'R') return x;
    const auto cosine = [](double degrees) { return std::fmod(degrees, 180) == 90 ? 0 : std::cos(degrees * kDegree); };
    const auto sine = [](double degrees) { return std::fmod(degrees, 180) == 0 ? 0 : std::sin(degrees * kDegree); };
    if (system == 'C') return {x[0] * cosine(x[1]), x[0] * sine(x[1]), x[2]};
    return {x[0] * cosine(x[1]) * cosine(x[2]), x[0] * sine(x[1]) * cosine(x[2]), x[0] * sine(x[2])};
  }

  void read_elements(const AbaqusKeyword& keyword) {
    const std::string type = abaqus_word(keyword.parameter("TYPE"));
    const std::string set = keyword.parameter("ELSET");
    if (!set.empty()) touch(set, file_.element_sets);
    if (const auto shape = abaqus_shape(type)) {
      while (!lines_.at_keyword()) read_element(*shape, type, set);
    } else if (type.empty() || type.find("3D") != std::string::npos) {
      // Trusses and beams in space have 3D in their names, too.
      if (type.starts_with("T3D") || type.starts_with("R3D") || type.starts_with("M3D") || type.starts_with("CONN") ||
          type.starts_with("DCOUP"))
        return leave_out(type, set);
      lines_.fail(fmt::format(
          "elements of type {}; solid elements that are read: {}. Correct the type, or mesh again with these",
          type.empty() ? "(none given)" : type, abaqus_solids()));
    } else {
      leave_out(type, set);
    }
  }

  // Sets may name them all the same. Their lines may go on, which only a line that begins no element can tell.
  void leave_out(const std::string& type, const std::string& set) {
    bool goes_on = false;
    while (!lines_.at_keyword()) {
      const std::string_view rest = lines_.rest_of_line();
      const bool ends_with_comma = !rest.empty() && rest[rest.find_last_not_of(" \t\r")] == ',';
      const auto& fields = lines_.data();
      if (!goes_on && !fields.empty()) {
        const std::int64_t tag = scopes_.number(fields[0], "the number of an element");
        file_.left_out.push_back({tag, lines_.place()});
        ++left_out_[type];
        if (!set.empty()) add(abaqus_number_member(tag, lines_.place()), set, file_.element_sets);
      }
      goes_on = ends_with_comma;
    }
  }

  // The nodes may go on in the next line.
  void read_element(const AbaqusShape& shape, const std::string& type, const std::string& set) {
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
        lines_.fail(fmt::format("element {} ends early: {} of the {} nodes of a {}; is the file truncated?", own,
                                nodes_.size(), shape.nodes, type));
      fields = &lines_.data();
      at = static_cast<std::size_t>(-1);
    }
    if (nodes_.size() > shape.nodes)
      lines_.fail(fmt::format("element {}: {} nodes, where a {} has {}; correct the type or the nodes", own,
                              nodes_.size(), type, shape.nodes));
    scopes_.note(own);
    shape.solid ? add_cell(tag, shape, place) : add_face(tag, shape, place);
    if (!set.empty()) add(abaqus_number_member(tag, place), set, file_.element_sets);
  }

  void add_cell(std::int64_t tag, const AbaqusShape& shape, FilePlace place) {
    FileCell& cell = file_.draft.cells.emplace_back(FileCell{.tag = tag, .kind = *shape.solid, .place = place});
    const auto middles = nodes_.begin() + static_cast<std::ptrdiff_t>(shape.corners);
    std::copy(nodes_.begin(), middles, cell.nodes.begin());
    if (shape.nodes == shape.corners) return;
    if (cell.kind == CellKind::tet) {
      std::copy(middles, nodes_.end(), cell.midsides.emplace().begin());
      return;
    }
    const auto& edges = edges_of(cell.kind);
    for (std::size_t e = 0; e < edges.size(); ++e)
      cell.edges.push_back({cell.nodes[edges[e][0]], cell.nodes[edges[e][1]], nodes_[shape.corners + e]});
  }

  void add_face(std::int64_t tag, const AbaqusShape& shape, FilePlace place) {
    FileFace& face = file_.faces.emplace_back(FileFace{.tag = tag, .sides = shape.corners, .place = place});
    const auto middles = nodes_.begin() + static_cast<std::ptrdiff_t>(shape.corners);
    std::copy(nodes_.begin(), middles, face.nodes.begin());
    file_.face_middles.emplace_back(middles, nodes_.end());
  }

  // The set of this name within the scope, which is made if it is new.
  AbaqusSet& touch(const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set =
        sets.try_emplace(scopes_.now().key(name), AbaqusSet{.name = name, .instance = scopes_.now().instance})
            .first->second;
    set.order = ++order_;
    return set;
  }

  void add(AbaqusMembers members, const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set = touch(name, sets);
    // Consecutive numbers of one keyword need no more room than a range.
    if (!set.members.empty() && members.set.empty()) {
      AbaqusMembers& last = set.members.back();
      if (last.set.empty() && last.step == 1 && members.step == 1 && last.listed == members.listed &&
          members.first == members.last && members.first > last.last && members.first - 1 == last.last) {
        last.last = members.last;
        return;
      }
    }
    set.members.push_back(std::move(members));
  }

  void read_set(const AbaqusKeyword& keyword, const char* parameter, AbaqusSets& sets) {
    const std::string name = lines_.name_of(keyword, parameter);
    const AbaqusScope of_members =
        keyword.has("INSTANCE") ? scopes_.instance(keyword.parameter("INSTANCE")) : scopes_.now();
    touch(name, sets);
    if (keyword.name == "NSET" && keyword.has("ELSET"))
      add({.set = of_members.key(lines_.name_of(keyword, "ELSET")), .place = keyword.place, .of_elements = true}, name,
          sets);
    const bool generate = keyword.has("GENERATE");
    while (!lines_.at_keyword()) {
      const std::vector<std::string_view>& fields = lines_.data();
      if (generate) {
        add(read_range(fields, scopes_.offset_of(of_members)), name, sets);
        continue;
      }
      for (const std::string_view field : fields) add(scopes_.member(field, of_members), name, sets);
    }
  }

  AbaqusMembers read_range(const std::vector<std::string_view>& fields, std::int64_t offset) {
    AbaqusMembers range{.place = lines_.place()};
    if (fields.size() < 2 || fields.size() > 3)
      lines_.fail(fmt::format("{} numbers; GENERATE needs the first, the last and an increment", fields.size()));
    range.first = lines_.integer(fields[0], "the first number");
    range.last = lines_.integer(fields[1], "the last number");
    if (fields.size() == 3) range.step = lines_.integer(fields[2], "the increment");
    if (range.step == 0 && range.first == range.last) range.step = 1;
    if (range.step < 1 || range.first < 0 || range.last < range.first)
      lines_.fail(fmt::format("from {} to {} by {}; the numbers must ascend", range.first, range.last, range.step));
    if (offset > 0) {
      range.last = std::min(range.last, kAbaqusAssembly) + offset;
      range.first += offset;
    }
    return range;
  }

  void read_surface(const AbaqusKeyword& keyword) {
    const std::string name = lines_.name_of(keyword);
    const std::string type = abaqus_word(keyword.parameter("TYPE"));
    if (!type.empty() && type != "ELEMENT") {
      skip("*SURFACE of type " + TextTokens::quoted(type));
      return lines_.skip_data();
    }
    AbaqusSurface& surface =
        file_.surfaces
            .try_emplace(scopes_.now().key(name), AbaqusSurface{.name = name, .instance = scopes_.now().instance})
            .first->second;
    while (!lines_.at_keyword()) {
      const std::vector<std::string_view> fields = lines_.data();
      if (fields.size() > 2) lines_.fail("expected an element set and a face; one pair on a line");
      if (fields.size() < 2) lines_.fail("a surface of elements without a face; give S1, S2, ...");
      surface.faces.push_back({scopes_.member(fields[0]), side_of(in_capitals(std::string(fields[1])))});
    }
  }

  std::size_t side_of(const std::string& side) const {
    if (side == "SPOS") return AbaqusFace::kPositive;
    if (side == "SNEG") return AbaqusFace::kNegative;
    if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6')
      lines_.fail(
          fmt::format("face {}; expected S1 to S4 of a tetrahedron, to S5 of a wedge or pyramid, to S6 of a "
                      "hexahedron, SPOS or SNEG of a shell",
                      TextTokens::quoted(side)));
    return static_cast<std::size_t>(side[1] - '1');
  }

  void read_section(const AbaqusKeyword& keyword) {
    const auto key = [&](const char* parameter) {
      return keyword.has(parameter) ? scopes_.now().key(keyword.parameter(parameter)) : "";
    };
    file_.sections.push_back({{.set = scopes_.now().key(lines_.name_of(keyword, "ELSET")), .place = keyword.place},
                              key("ORIENTATION"),
                              in_capitals(keyword.parameter("MATERIAL"))});
    lines_.skip_data();
  }

  // Of several instances, or where the assembly has the same name, names within an instance begin with its own.
  void name_sets() {
    const auto name_all = [&](auto& things) {
      for (auto& [key, thing] : things)
        if (!thing.instance.empty() && (scopes_.instances().size() > 1 || things.contains(in_capitals(thing.name))))
          thing.name = thing.instance + "." + thing.name;
    };
    name_all(file_.node_sets);
    name_all(file_.element_sets);
    name_all(file_.surfaces);
  }

  void warn() {
    Warnings& warnings = file_.draft.warnings;
    const std::string& path = file_.draft.files.front();
    std::vector<std::string> others, shifted;
    for (const auto& [type, count] : left_out_) others.push_back(fmt::format("{} ({})", type, count));
    if (!others.empty())
      warnings.push_back(
          fmt::format("{}: elements that are neither solids nor surfaces are left out: {}", path, join(others)));
    for (const auto& [key, scope] : scopes_.instances())
      if (scope.offset > 0) shifted.push_back(fmt::format("{} is added to those of {}", scope.offset, scope.instance));
    if (!shifted.empty()) warnings.push_back(fmt::format("{}: numbers of nodes and elements: {}", path, join(shifted)));
    std::vector<std::string> skipped;
    for (const auto& [what, place] : file_.skipped) skipped.push_back(what);
    if (!skipped.empty())
      warnings.push_back(
          fmt::format("{}: only mesh and materials are read here; a scene has its own clamps and loads "
                      "(`orthodyn init --from` takes over those of the file). Skipped: {}",
                      path, join(skipped)));
  }

  struct Part {
    std::string name;
    AbaqusLines::Mark mark;
    bool is_placed = false;
  };

  AbaqusFile file_;
  AbaqusLines lines_;
  AbaqusScopes scopes_{lines_};
  AbaqusMaterialReader materials_{lines_, file_.materials};
  AbaqusOrientationReader orientations_{lines_, scopes_, file_};
  AbaqusHistoryReader history_{lines_, scopes_, file_};
  std::map<std::string, Part> parts_;
  std::map<std::string, std::size_t> left_out_;  // by type
  std::vector<std::int64_t> nodes_;              // of the element that is read
  int order_ = 0;
};

}  // namespace

AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text) {
  return AbaqusReader(path, text).read();
}

}  // namespace orthodyn
