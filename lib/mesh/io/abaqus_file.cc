#include "lib/mesh/io/abaqus_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/core/words.h"
#include "lib/mesh/io/abaqus_lines.h"
#include "lib/mesh/io/abaqus_sets.h"
#include "lib/mesh/io/abaqus_types.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// What a keyword is within: the model or assembly (no name), or an instance.
struct Scope {
  std::string instance = {};  // as spelled
  std::int64_t offset = 0;    // is added to numbers of nodes and elements
  AbaqusPlacement placement = {};

  std::string key(const std::string& name) const {
    return instance.empty() ? in_capitals(name) : in_capitals(instance + "." + name);
  }
};

class AbaqusReader {
 public:
  AbaqusReader(const std::string& path, std::string_view text) : file_(draft_of(path)), lines_(file_.draft, text), materials_(lines_, file_.materials) {}

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
    if (materials_.read(keyword)) return;
    if (name == "NODE") return read_nodes(keyword);
    if (name == "ELEMENT") return read_elements(keyword);
    if (name == "NSET") return read_set(keyword, "NSET", file_.node_sets);
    if (name == "ELSET") return read_set(keyword, "ELSET", file_.element_sets);
    if (name == "SURFACE") return read_surface(keyword);
    if (name == "SOLIDSECTION") return read_section(keyword);
    if (name == "ORIENTATION") return read_orientation(keyword);
    if (name == "DISTRIBUTION") return read_distribution(keyword);
    if (name == "DISTRIBUTIONTABLE") return read_table(keyword);
    if (name == "PART") return note_part(keyword);
    if (name == "INSTANCE") return place_instance(keyword);
    if (name == "ASSEMBLY" || name == "ENDASSEMBLY" || name == "ENDPART" || name == "ENDINSTANCE" ||
        name == "HEADING" || name == "PREPRINT")
      return lines_.skip_data();
    refuse_what_makes_nodes(keyword);
    skip(keyword.spelled);
    read_history(keyword);
    lines_.skip_data();
  }

  // What only the conditions of a scene need.
  void read_history(const AbaqusKeyword& keyword) {
    const std::string& name = keyword.name;
    if (name == "STEP") file_.steps.push_back(keyword);
    if (name == "STATIC" || name == "DYNAMIC" || name == "VISCO" || name == "COUPLED TEMPERATURE-DISPLACEMENT")
      read_period();
    if (name == "AMPLITUDE")
      file_.amplitudes[in_capitals(keyword.parameter("NAME"))] = read_abaqus_amplitude(keyword, lines_);
    if (name == "TRANSFORM")
      file_.transforms.push_back(
          read_abaqus_transform(keyword, scope_.key(keyword.parameter("NSET")), scope_.placement.R, lines_));
    if (name == "BOUNDARY" || name == "CLOAD" || name == "DLOAD" || name == "DSLOAD") read_conditions(keyword);
  }

  // The second number of a procedure; without one, or with zero, a step lasts 1 s.
  void read_period() {
    if (file_.steps.size() != 1 || lines_.at_keyword()) return;
    const auto& fields = lines_.data();
    const double period = fields.size() > 1 ? abaqus_number(fields[1]).value_or(0) : 0;
    if (period > 0) file_.first_period = period;
  }

  void skip(const std::string& what) { file_.skipped.try_emplace(what, lines_.place()); }

  void read_conditions(const AbaqusKeyword& keyword) {
    std::map<std::string, std::string> made;  // by what stands behind the numbers: the key of their set
    while (!lines_.at_keyword()) {
      const auto fields = lines_.data();
      if (fields.empty()) continue;
      AbaqusCondition condition{keyword, file_.steps.size(), "", {fields.begin() + 1, fields.end()}, lines_.place()};
      if (fields[0].empty() || gather(condition, member(fields[0], scope_), made))
        file_.conditions.push_back(std::move(condition));
    }
  }

  // Gives the condition its target. False where that was given to one with the same fields before, which acts on these
  // numbers, too.
  bool gather(AbaqusCondition& condition, const AbaqusMembers& members, std::map<std::string, std::string>& made) {
    const std::string& name = condition.keyword.name;
    const std::string label = condition.fields.empty() ? "" : abaqus_word(condition.fields[0]);
    const bool of_faces = name == "DLOAD" && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6';
    condition.target = members.set;
    if (!of_faces && (!members.set.empty() || name == "DLOAD" || name == "DSLOAD")) return true;
    const auto [found, is_new] = made.try_emplace(join(condition.fields));
    if (is_new) found->second = of_faces ? make_own(name, file_.surfaces) : make_own(name, file_.node_sets);
    condition.target = found->second;
    if (of_faces) file_.surfaces[found->second].faces.push_back({members, static_cast<std::size_t>(label[1] - '1')});
    else file_.node_sets[found->second].members.push_back(members);
    return is_new;
  }

  // A set or surface of a condition; returns its key.
  template <class Thing>
  static std::string make_own(const std::string& keyword, std::map<std::string, Thing>& things) {
    std::string name = keyword;
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (int k = 1;; ++k) {
      Thing own{.name = fmt::format("{}_{}", name, k)};
      own.of_condition = true;
      const std::string key = in_capitals(own.name);
      if (things.emplace(key, std::move(own)).second) return key;
    }
  }

  void refuse_what_makes_nodes(const AbaqusKeyword& keyword) const {
    for (const char* name : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "SUBMODEL", "IMPORT",
                             "SYMMETRICMODELGENERATION"}) {
      if (keyword.name != name) continue;
      lines_.fail(fmt::format("{} is not read; write the nodes and elements themselves, in global coordinates",
                              keyword.spelled));
    }
  }

  std::string name_of(const AbaqusKeyword& keyword, const char* parameter = "NAME") const {
    const std::string name = keyword.parameter(parameter);
    if (name.empty()) lines_.fail(fmt::format("{} without {}=name", keyword.spelled, parameter));
    return name;
  }

  // One of the values of a parameter, which may be shortened as long as it begins alike.
  std::string choice(const AbaqusKeyword& keyword, const char* parameter,
                     const std::vector<std::string>& values) const {
    const std::string given = abaqus_word(keyword.parameter(parameter));
    if (given.empty()) return values.front();
    for (const std::string& value : values)
      if (abaqus_word(value).starts_with(given)) return value;
    lines_.fail(fmt::format("{}, {}={} is not read; read are {}", keyword.spelled, parameter,
                            TextTokens::quoted(keyword.parameter(parameter)), join(values)));
  }

  void note_part(const AbaqusKeyword& keyword) {
    lines_.skip_data();
    const auto [part, is_new] = parts_.emplace(in_capitals(name_of(keyword)), Part{name_of(keyword), lines_.mark()});
    if (!is_new) lines_.fail(fmt::format("a second *PART {}", TextTokens::quoted(part->second.name)));
    while (lines_.at_keyword() && !lines_.at_end()) {
      const std::string name = lines_.keyword().name;
      lines_.skip_data();
      if (name == "ENDPART") return;
    }
  }

  // The part is read once for each of its instances.
  void place_instance(const AbaqusKeyword& keyword) {
    const std::string name = name_of(keyword), part = name_of(keyword, "PART");
    const auto found = parts_.find(in_capitals(part));
    if (found == parts_.end()) lines_.fail(fmt::format("*INSTANCE: no *PART {}", TextTokens::quoted(part)));
    const Scope outside = scope_;
    scope_ = {name, next_offset(), read_placement()};
    if (!instances_.emplace(in_capitals(name), scope_).second)
      file_.draft.fail(keyword.place, fmt::format("a second *INSTANCE {}", TextTokens::quoted(name)));
    found->second.is_placed = true;
    lines_.enter(found->second.mark);
    read_until("ENDPART");
    lines_.leave();
    read_until("ENDINSTANCE");
    scope_ = outside;
  }

  // Behind the numbers of earlier instances, and so that the part's own numbers can be read in the sum.
  std::int64_t next_offset() const {
    if (instances_.empty()) return 0;
    std::int64_t power = 1000;
    while (power <= largest_ && power < (std::int64_t{1} << 50)) power *= 10;
    return power * static_cast<std::int64_t>(instances_.size());
  }

  // A shift, then a turn about the line from a to b.
  AbaqusPlacement read_placement() {
    AbaqusPlacement placement;
    if (lines_.at_keyword()) return placement;
    if (lines_.data().size() > 3) lines_.fail("*INSTANCE: expected three components of a translation");
    for (std::size_t k = 0; k < 3; ++k) placement.t[static_cast<Eigen::Index>(k)] = lines_.real(k, "a translation");
    if (lines_.at_keyword()) return placement;
    const bool complete = lines_.data().size() == 7;
    Vec3 a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[static_cast<Eigen::Index>(k)] = lines_.real(k, "a coordinate");
      b[static_cast<Eigen::Index>(k)] = lines_.real(k + 3, "a coordinate");
    }
    const double angle = lines_.real(6, "an angle in degrees") * kDegree;
    if (!complete || !((b - a).norm() > 0))
      lines_.fail("*INSTANCE: expected two different points of the axis of rotation and an angle in degrees");
    placement.R = Eigen::AngleAxisd(angle, (b - a).normalized()).toRotationMatrix();
    placement.t = a + placement.R * (placement.t - a);
    if (!lines_.at_keyword()) lines_.fail("*INSTANCE: a third line of data; expected a translation and a rotation");
    return placement;
  }

  // Without instances, a single part is the model.
  void place_single_part() {
    if (instances_.empty() && parts_.size() == 1) {
      lines_.enter(parts_.begin()->second.mark);
      read_until("ENDPART");
      lines_.leave();
    } else if (instances_.empty() && parts_.size() > 1) {
      lines_.fail(fmt::format("{} parts, and no *INSTANCE that places them", parts_.size()));
    } else {
      for (const auto& [key, part] : parts_)
        if (!part.is_placed) skip("*PART " + TextTokens::quoted(part.name) + ", which no *INSTANCE places");
    }
  }

  // The assembly has nodes of its own beside those of its instances.
  std::int64_t offset_of(const Scope& scope) const {
    return scope.instance.empty() && !instances_.empty() ? kAbaqusAssembly : scope.offset;
  }

  std::int64_t number(std::string_view field, const char* what, std::int64_t offset) const {
    const std::int64_t found = lines_.integer(field, what);
    if (found < 0 || found >= kAbaqusAssembly)
      lines_.fail(fmt::format("{} is {}; it must be between 0 and 10^15", what, found));
    return found + offset;
  }
  std::int64_t number(std::string_view field, const char* what) const { return number(field, what, offset_of(scope_)); }

  void read_nodes(const AbaqusKeyword& keyword) {
    const std::string set = keyword.parameter("NSET");
    const std::string system = choice(keyword, "SYSTEM", {"RECTANGULAR", "CYLINDRICAL", "SPHERICAL"});
    while (!lines_.at_keyword()) {
      const auto& fields = lines_.data();
      FileNode node{.place = lines_.place()};
      node.tag = number(fields.empty() ? "" : fields[0], "the number of a node");
      if (fields.size() > 7)  // coordinates and direction cosines
        lines_.fail(fmt::format("{} numbers behind the number of a node; it has three coordinates", fields.size() - 1));
      Vec3 x;
      for (std::size_t k = 0; k < 3; ++k) x[static_cast<Eigen::Index>(k)] = lines_.real(k + 1, "a coordinate");
      node.x = scope_.placement(cartesian(x, system[0]));
      largest_ = std::max(largest_, node.tag - offset_of(scope_));
      file_.draft.nodes.push_back(node);
      if (!set.empty()) add(one(node.tag, node.place), set, file_.node_sets);
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
        const std::int64_t tag = number(fields[0], "the number of an element");
        file_.left_out.push_back({tag, lines_.place()});
        ++left_out_[type];
        if (!set.empty()) add(one(tag, lines_.place()), set, file_.element_sets);
      }
      goes_on = ends_with_comma;
    }
  }

  // The nodes may go on in the next line.
  void read_element(const AbaqusShape& shape, const std::string& type, const std::string& set) {
    const std::vector<std::string_view>* fields = &lines_.data();
    const FilePlace place = lines_.place();
    const std::int64_t tag = number(fields->empty() ? "" : (*fields)[0], "the number of an element");
    const std::int64_t own = tag - offset_of(scope_);
    nodes_.clear();
    for (std::size_t at = 1; nodes_.size() < shape.nodes || at < fields->size(); ++at) {
      if (at < fields->size()) {
        nodes_.push_back(number((*fields)[at], "a node"));
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
    largest_ = std::max(largest_, own);
    shape.solid ? add_cell(tag, shape, place) : add_face(tag, shape, place);
    if (!set.empty()) add(one(tag, place), set, file_.element_sets);
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

  static AbaqusMembers one(std::int64_t number, FilePlace place) {
    return {.first = number, .last = number, .place = place, .listed = true};
  }

  // The set of this name within the scope, which is made if it is new.
  AbaqusSet& touch(const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set =
        sets.try_emplace(scope_.key(name), AbaqusSet{.name = name, .instance = scope_.instance}).first->second;
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
    const std::string name = name_of(keyword, parameter);
    const Scope of_members = keyword.has("INSTANCE") ? instance_of(keyword.parameter("INSTANCE")) : scope_;
    touch(name, sets);
    if (keyword.name == "NSET" && keyword.has("ELSET"))
      add({.set = of_members.key(name_of(keyword, "ELSET")), .place = keyword.place, .of_elements = true}, name, sets);
    const bool generate = keyword.has("GENERATE");
    while (!lines_.at_keyword()) {
      const std::vector<std::string_view>& fields = lines_.data();
      if (generate) {
        add(read_range(fields, offset_of(of_members)), name, sets);
        continue;
      }
      for (const std::string_view field : fields) add(member(field, of_members), name, sets);
    }
  }

  const Scope& instance_of(const std::string& name) const {
    const auto found = instances_.find(in_capitals(name));
    if (found == instances_.end()) lines_.fail(fmt::format("no *INSTANCE {}", TextTokens::quoted(name)));
    return found->second;
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

  // A number or a set, with the name of an instance in front or of the scope.
  AbaqusMembers member(std::string_view field, const Scope& scope) {
    for (const auto& [key, instance] : instances_) {
      if (field.size() <= key.size() + 1 || field[key.size()] != '.' ||
          in_capitals(std::string(field.substr(0, key.size()))) != key)
        continue;
      return member_within(field.substr(key.size() + 1), instance);
    }
    return member_within(field, scope);
  }

  AbaqusMembers member_within(std::string_view field, const Scope& scope) {
    const bool is_number =
        !field.empty() && (std::isdigit(static_cast<unsigned char>(field[0])) || field[0] == '-' || field[0] == '+');
    if (is_number) return one(number(field, "a number", offset_of(scope)), lines_.place());
    if (field.empty()) lines_.fail("an empty place among the members of a set");
    return {.set = scope.key(std::string(field)), .place = lines_.place()};
  }

  void read_surface(const AbaqusKeyword& keyword) {
    const std::string name = name_of(keyword);
    const std::string type = abaqus_word(keyword.parameter("TYPE"));
    if (!type.empty() && type != "ELEMENT") {
      skip("*SURFACE of type " + TextTokens::quoted(type));
      return lines_.skip_data();
    }
    AbaqusSurface& surface =
        file_.surfaces.try_emplace(scope_.key(name), AbaqusSurface{.name = name, .instance = scope_.instance})
            .first->second;
    while (!lines_.at_keyword()) {
      const std::vector<std::string_view> fields = lines_.data();
      if (fields.size() > 2) lines_.fail("expected an element set and a face; one pair on a line");
      if (fields.size() < 2) lines_.fail("a surface of elements without a face; give S1, S2, ...");
      surface.faces.push_back({member(fields[0], scope_), side_of(in_capitals(std::string(fields[1])))});
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
      return keyword.has(parameter) ? scope_.key(keyword.parameter(parameter)) : "";
    };
    file_.sections.push_back({{.set = scope_.key(name_of(keyword, "ELSET")), .place = keyword.place},
                              key("ORIENTATION"),
                              in_capitals(keyword.parameter("MATERIAL"))});
    lines_.skip_data();
  }

  // The points a, b and perhaps c, or their nodes, or the name of a distribution; then perhaps the axis to turn about
  // and an angle in degrees, or the name of a distribution.
  void read_orientation(const AbaqusKeyword& keyword) {
    using System = AbaqusOrientation::System;
    AbaqusOrientation out{.name = name_of(keyword), .placement = scope_.placement, .place = keyword.place};
    static const std::vector<std::string> systems{"RECTANGULAR", "Z RECTANGULAR", "CYLINDRICAL", "SPHERICAL"};
    const auto system = std::find(systems.begin(), systems.end(), choice(keyword, "SYSTEM", systems));
    out.system = static_cast<System>(system - systems.begin());
    const bool by_nodes = choice(keyword, "DEFINITION", {"COORDINATES", "NODES"}) == "NODES";
    if (lines_.at_keyword()) lines_.fail("*ORIENTATION without points");
    const auto fields = lines_.data();
    if (by_nodes) {
      for (const std::string_view field : fields) out.nodes.push_back(number(field, "a node"));
      check_points(out, fields.size());
    } else if (is_name(fields)) {
      out.distribution = scope_.key(std::string(fields[0]));
    } else {
      check_points(out, fields.size() / 3);
      if (fields.size() % 3 != 0)
        lines_.fail(fmt::format("*ORIENTATION with {} coordinates; expected two points, or three", fields.size()));
      for (std::size_t k = 0; k < fields.size(); ++k)
        out.points[k / 3][static_cast<Eigen::Index>(k % 3)] = lines_.real(k, "a coordinate");
    }
    for (Vec3& point : out.points) point = scope_.placement(point);
    if (!lines_.at_keyword()) read_turn(out);
    lines_.skip_data();
    file_.orientations[scope_.key(out.name)] = std::move(out);
  }

  void check_points(const AbaqusOrientation& orientation, std::size_t points) const {
    using enum AbaqusOrientation::System;
    const bool may_have_origin = orientation.system == rectangular || orientation.system == z_rectangular;
    if (points == 2 || (points == 3 && may_have_origin)) return;
    lines_.fail(fmt::format(
        "*ORIENTATION with {}; expected two points{}",
        orientation.nodes.empty() ? fmt::format("{} coordinates", lines_.size()) : fmt::format("{} nodes", points),
        may_have_origin ? ", or three" : ""));
  }

  static bool is_name(const std::vector<std::string_view>& fields) {
    return !fields.empty() && !fields[0].empty() &&
           (std::isalpha(static_cast<unsigned char>(fields[0][0])) || fields[0][0] == '_');
  }

  void read_turn(AbaqusOrientation& out) {
    const auto fields = lines_.data();
    const std::int64_t axis =
        fields.empty() || fields[0].empty() ? 1 : lines_.integer(fields[0], "the axis to turn about");
    if (axis < 1 || axis > 3) lines_.fail(fmt::format("axis {} of *ORIENTATION; expected 1, 2 or 3", axis));
    out.axis = axis - 1;
    if (fields.size() > 1 && is_name({fields[1]})) out.angles = scope_.key(std::string(fields[1]));
    else out.degrees = lines_.real(1, "an angle in degrees");
  }

  void read_table(const AbaqusKeyword& keyword) {
    std::vector<std::string>& labels = tables_[in_capitals(name_of(keyword))];
    while (!lines_.at_keyword())
      for (const std::string_view field : lines_.data()) labels.push_back(abaqus_word(field));
  }

  // How many values a row has. CalculiX has distributions of axes only, without a table.
  std::size_t values_of(const AbaqusKeyword& keyword) const {
    if (!keyword.has("TABLE")) return 6;
    const auto table = tables_.find(in_capitals(keyword.parameter("TABLE")));
    if (table == tables_.end())
      lines_.fail(
          fmt::format("*DISTRIBUTION: no *DISTRIBUTION TABLE {}", TextTokens::quoted(keyword.parameter("TABLE"))));
    if (table->second == std::vector<std::string>{"COORD3D", "COORD3D"}) return 6;
    return table->second == std::vector<std::string>{"ANGLE"} ? 1 : 0;
  }

  void read_distribution(const AbaqusKeyword& keyword) {
    AbaqusDistribution out{.name = name_of(keyword), .place = keyword.place};
    const std::string location = abaqus_word(keyword.parameter("LOCATION"));
    if (location.empty() || location == "ELEMENT") out.count = values_of(keyword);
    if (out.count == 0) {
      skip("*DISTRIBUTION " + TextTokens::quoted(out.name));
      lines_.skip_data();
    }
    while (!lines_.at_keyword()) {
      const auto& fields = lines_.data();
      if (fields.size() > out.count + 1)
        lines_.fail(fmt::format("{} values; a row of distribution {} has {}", fields.size() - 1,
                                TextTokens::quoted(out.name), out.count));
      AbaqusDistribution::Row row;
      for (std::size_t k = 0; k < out.count; ++k) row.values[k] = lines_.real(k + 1, "a value");
      const bool of_others = fields.empty() || fields[0].empty();
      if (!of_others) row.elements = member(fields[0], scope_);
      if (of_others) out.others = {row};
      else out.rows.push_back(std::move(row));
    }
    file_.distributions[scope_.key(out.name)] = std::move(out);
  }

  // Of several instances, or where the assembly has the same name, names within an instance begin with its own.
  void name_sets() {
    const auto name_all = [&](auto& things) {
      for (auto& [key, thing] : things)
        if (!thing.instance.empty() && (instances_.size() > 1 || things.contains(in_capitals(thing.name))))
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
    for (const auto& [key, scope] : instances_)
      if (scope.offset > 0) shifted.push_back(fmt::format("{} is added to those of {}", scope.offset, scope.instance));
    if (!shifted.empty()) warnings.push_back(fmt::format("{}: numbers of nodes and elements: {}", path, join(shifted)));
    std::vector<std::string> skipped;
    for (const auto& [what, place] : file_.skipped) skipped.push_back(what);
    if (!skipped.empty())
      warnings.push_back(fmt::format("{}: only mesh and materials are read here; a scene has its own clamps and loads "
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
  AbaqusMaterialReader materials_;
  Scope scope_;
  std::map<std::string, Part> parts_;
  std::map<std::string, Scope> instances_;
  std::map<std::string, std::vector<std::string>> tables_;
  std::map<std::string, std::size_t> left_out_;  // by type
  std::vector<std::int64_t> nodes_;  // of the element that is read
  std::int64_t largest_ = 0;         // number of a node or element of a part
  int order_ = 0;
};

}  // namespace

AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text) {
  return AbaqusReader(path, text).read();
}

}  // namespace orthodyn
