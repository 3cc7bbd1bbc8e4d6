#include "lib/mesh/io/abaqus_file.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus_elements.h"
#include "lib/mesh/io/abaqus_history.h"
#include "lib/mesh/io/abaqus_orientations.h"

namespace orthodyn {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class AbaqusReader {
 public:
  AbaqusReader(const std::string& path, std::string_view text) : file_(draft_of(path)), lines_(file_.draft, text) {}

  AbaqusFile read() {
    if (!lines_.at_keyword())
      lines_.fail("expected a keyword (*NODE), found {}; this is not an Abaqus input file (.inp)",
                  TextTokens::quoted(lines_.data()[0]));
    read_until("");
    read_single_part();
    name_sets();
    check_set_nesting(file_);
    add_warnings();
    return std::move(file_);
  }

 private:
  static AbaqusFile draft_of(const std::string& path) {
    AbaqusFile file;
    file.draft.files = {path};
    file.draft.nodes_section = "*NODE";
    return file;
  }

  // Reads up to the keyword `last`, or to the end.
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
    if (name == "ELEMENT") return elements_.read(keyword);
    if (name == "NSET") return sets_.read(keyword, "NSET", file_.node_sets);
    if (name == "ELSET") return sets_.read(keyword, "ELSET", file_.element_sets);
    if (name == "SURFACE") return read_surface(keyword);
    if (name == "SOLIDSECTION") return read_section(keyword);
    if (name == "PART") return locate_part(keyword);
    if (name == "INSTANCE") return read_instance(keyword);
    if (name == "ASSEMBLY" || name == "ENDASSEMBLY" || name == "ENDPART" || name == "ENDINSTANCE" ||
        name == "HEADING" || name == "PREPRINT")
      return lines_.skip_data();
    refuse_generated_mesh(keyword);
    skip(keyword.spelled);
    history_.read(keyword);
    lines_.skip_data();
  }

  void skip(const std::string& what) { file_.skipped.try_emplace(what, lines_.place()); }

  void refuse_generated_mesh(const AbaqusKeyword& keyword) const {
    for (const char* name : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "SUBMODEL", "IMPORT",
                             "SYMMETRICMODELGENERATION"}) {
      if (keyword.name != name) continue;
      lines_.fail("{} is not read; write the nodes and elements themselves, in global coordinates", keyword.spelled);
    }
  }

  // Stores where a part begins; its instances read it.
  void locate_part(const AbaqusKeyword& keyword) {
    lines_.skip_data();
    const std::string name = lines_.name_of(keyword);
    const auto [part, is_new] = parts_.emplace(in_capitals(name), Part{name, lines_.mark()});
    if (!is_new) lines_.fail("*PART {} is defined twice", TextTokens::quoted(part->second.name));
    while (lines_.at_keyword() && !lines_.at_end()) {
      const std::string next = lines_.keyword().name;
      lines_.skip_data();
      if (next == "ENDPART") return;
    }
  }

  void read_instance(const AbaqusKeyword& keyword) {
    const std::string name = lines_.name_of(keyword), part = lines_.name_of(keyword, "PART");
    const auto found = parts_.find(in_capitals(part));
    if (found == parts_.end()) lines_.fail("*INSTANCE: no *PART {}", TextTokens::quoted(part));
    scopes_.enter(name);
    found->second.is_placed = true;
    lines_.enter(found->second.mark);
    read_until("ENDPART");
    lines_.leave();
    read_until("ENDINSTANCE");
    scopes_.leave();
  }

  // Without instances, a single part is the model.
  void read_single_part() {
    if (scopes_.instances().empty() && parts_.size() == 1) {
      lines_.enter(parts_.begin()->second.mark);
      read_until("ENDPART");
      lines_.leave();
    } else if (scopes_.instances().empty() && parts_.size() > 1) {
      lines_.fail("{} parts, but no *INSTANCE places them", parts_.size());
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
        lines_.fail("{} numbers after the node number; expected three coordinates", fields.size() - 1);
      Vec3 x;
      for (std::size_t k = 0; k < 3; ++k) x[static_cast<Eigen::Index>(k)] = lines_.real(k + 1, "a coordinate");
      node.x = scopes_.current().placement(cartesian(x, system[0]));
      scopes_.record_number(node.tag - scopes_.offset());
      file_.draft.nodes.push_back(node);
      if (!set.empty()) sets_.add(abaqus_number_member(node.tag, node.place), set, file_.node_sets);
    }
  }

  // Angles in degrees: azimuth, and for spherical coordinates the elevation above the x-y plane.
  static Vec3 cartesian(const Vec3& x, char system) {
    if (system == 'R') return x;
    const auto cosine = [](double degrees) { return std::fmod(degrees, 180) == 90 ? 0 : std::cos(degrees * kDegree); };
    const auto sine = [](double degrees) { return std::fmod(degrees, 180) == 0 ? 0 : std::sin(degrees * kDegree); };
    if (system == 'C') return {x[0] * cosine(x[1]), x[0] * sine(x[1]), x[2]};
    return {x[0] * cosine(x[1]) * cosine(x[2]), x[0] * sine(x[1]) * cosine(x[2]), x[0] * sine(x[2])};
  }

  void read_surface(const AbaqusKeyword& keyword) {
    const std::string name = lines_.name_of(keyword);
    const std::string type = abaqus_word(keyword.parameter("TYPE"));
    if (!type.empty() && type != "ELEMENT") {
      skip("*SURFACE of type " + TextTokens::quoted(type));
      return lines_.skip_data();
    }
    AbaqusSurface& surface = file_.surfaces
                                 .try_emplace(scopes_.current().key(name),
                                              AbaqusSurface{.name = name, .instance = scopes_.current().instance})
                                 .first->second;
    while (!lines_.at_keyword()) {
      const std::vector<std::string_view> fields = lines_.data();
      if (fields.size() > 2) lines_.fail("expected one element set and one face per line");
      if (fields.size() < 2) lines_.fail("a surface of elements needs a face; give S1, S2, ...");
      surface.faces.push_back({scopes_.member(fields[0]), side_of(in_capitals(std::string(fields[1])))});
    }
  }

  std::size_t side_of(const std::string& side) const {
    if (side == "SPOS") return AbaqusFace::kPositive;
    if (side == "SNEG") return AbaqusFace::kNegative;
    if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6')
      lines_.fail(
          "face {}; expected S1 to S4 of a tetrahedron, to S5 of a wedge or pyramid, to S6 of a hexahedron, SPOS or "
          "SNEG of a shell",
          TextTokens::quoted(side));
    return static_cast<std::size_t>(side[1] - '1');
  }

  void read_section(const AbaqusKeyword& keyword) {
    const auto key = [&](const char* parameter) {
      return keyword.has(parameter) ? scopes_.current().key(keyword.parameter(parameter)) : "";
    };
    AbaqusSection section{{.set = scopes_.current().key(lines_.name_of(keyword, "ELSET")), .place = keyword.place},
                          key("ORIENTATION"),
                          in_capitals(keyword.parameter("MATERIAL"))};
    if (keyword.has("COMPOSITE")) read_plies(keyword, section);
    else lines_.skip_data();
    file_.sections.push_back(std::move(section));
  }

  // One ply per line: thickness, number of integration points (not used), material, angle or orientation.
  void read_plies(const AbaqusKeyword& keyword, AbaqusSection& section) {
    if (keyword.has("MATERIAL"))
      lines_.fail("*SOLID SECTION with COMPOSITE and MATERIAL; the plies give the materials");
    section.stack_direction = lines_.choice(keyword, "STACKDIRECTION", {"3", "2", "1"})[0] - '0';
    while (!lines_.at_keyword()) {
      const auto fields = lines_.data();
      if (fields.size() < 3) lines_.fail("a ply with {} fields; expected thickness, points, material", fields.size());
      AbaqusPly ply{.thickness = lines_.real(0, "the thickness of a ply"),
                    .material = in_capitals(std::string(fields[2])),
                    .place = lines_.place()};
      if (!(ply.thickness > 0)) lines_.fail("a ply of thickness {}; it must be positive", ply.thickness);
      if (fields.size() > 3 && abaqus_is_name(fields[3]))
        ply.orientation = scopes_.current().key(std::string(fields[3]));
      else ply.degrees = lines_.real(3, "the angle of a ply");
      section.plies.push_back(std::move(ply));
    }
    if (section.plies.empty()) lines_.fail("*SOLID SECTION, COMPOSITE without plies");
    if (keyword.has("SYMMETRIC"))
      for (std::size_t k = section.plies.size(); k > 0; --k) section.plies.push_back(AbaqusPly(section.plies[k - 1]));
  }

  // With several instances, or if the assembly uses the same name, names within an instance get its name as a prefix.
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

  void add_warnings() {
    std::vector<std::string> others, shifted, skipped;
    for (const auto& [type, count] : elements_.ignored()) others.push_back(fmt::format("{} ({})", type, count));
    if (!others.empty())
      file_.draft.warn({}, "elements that are neither solids nor surfaces are left out: {}", join(others));
    for (const auto& [key, scope] : scopes_.instances())
      if (scope.offset > 0) shifted.push_back(fmt::format("{} is added to those of {}", scope.offset, scope.instance));
    if (!shifted.empty()) file_.draft.warn({}, "numbers of nodes and elements: {}", join(shifted));
    for (const auto& [what, place] : file_.skipped) skipped.push_back(what);
    if (!skipped.empty())
      file_.draft.warn({},
                       "only mesh and materials are read here; a scene has its own clamps and loads (`orthodyn init "
                       "--from` takes over those of the file). Skipped: {}",
                       join(skipped));
  }

  struct Part {
    std::string name;
    AbaqusLines::Mark mark;
    bool is_placed = false;
  };

  AbaqusFile file_;
  AbaqusLines lines_;
  AbaqusScopes scopes_{lines_};
  AbaqusSetReader sets_{lines_, scopes_};
  AbaqusElementReader elements_{lines_, scopes_, sets_, file_};
  AbaqusMaterialReader materials_{lines_, file_.materials};
  AbaqusOrientationReader orientations_{lines_, scopes_, file_};
  AbaqusHistoryReader history_{lines_, scopes_, file_};
  std::map<std::string, Part> parts_;
};

}  // namespace

AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text) {
  return AbaqusReader(path, text).read();
}

}  // namespace orthodyn
