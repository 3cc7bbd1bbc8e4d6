#include "lib/scene/abaqus_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "lib/config/values.h"
#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus_sets.h"
#include "lib/scene/abaqus_factors.h"
#include "lib/scene/abaqus_rotated_nodes.h"

namespace orthodyn {
namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

// Components that a named boundary condition fixes. Source: *BOUNDARY, "types of boundary conditions".
const std::map<std::string, std::vector<std::size_t>>& named_supports() {
  static const std::map<std::string, std::vector<std::size_t>> all{
      {"ENCASTRE", {0, 1, 2}}, {"PINNED", {0, 1, 2}}, {"XSYMM", {0}},     {"YSYMM", {1}},
      {"ZSYMM", {2}},          {"XASYMM", {1, 2}},    {"YASYMM", {0, 2}}, {"ZASYMM", {0, 1}}};
  return all;
}

std::string components_yaml(const std::vector<std::size_t>& components) {
  std::vector<std::string> names;
  for (const std::size_t c : components) names.push_back(kAxes[c]);
  return components.size() == 3 ? "" : fmt::format(", components: [{}]", join(names));
}

class ConditionWriter {
 public:
  ConditionWriter(const AbaqusFile& deck, const LoadedMesh& loaded, const AbaqusSceneOptions& options)
      : deck_(deck), loaded_(loaded), units_(factors_of(options.units)), is_static_(options.is_static) {}

  SceneConditions write() {
    for (const AbaqusCondition& c : deck_.conditions)
      if (c.step == 1 && abaqus_word(c.keyword.parameter("OP")) == "NEW") replaced_.insert(c.keyword.name);
    for (const AbaqusCondition& c : deck_.conditions)
      if (const std::string why = add(c); !why.empty()) leave_out(c, why);
    add_supports();
    add_forces();
    if (gravity_ != Vec3::Zero()) out_.gravity = Value<Vec3>::yaml(units_.length * gravity_);
    out_.is_linear = !deck_.steps.empty() && is_linear();
    if (factors_.any_taken()) out_.end = deck_.first_period;
    for (const auto& [what, lines] : left_out_)
      out_.left_out.push_back(fmt::format("{} ({} {}): {}", what.first, lines.size() == 1 ? "line" : "lines",
                                          shortened(lines), what.second));
    for (std::string& amplitude : factors_.not_taken()) out_.left_out.push_back(std::move(amplitude));
    return std::move(out_);
  }

 private:
  // Whether the first step is geometrically linear.
  bool is_linear() const {
    if (deck_.steps.empty()) return true;
    const AbaqusKeyword& step = deck_.steps.front();
    return !step.has("NLGEOM") || abaqus_word(step.parameter("NLGEOM")) == "NO";
  }

  // Converts a line; returns the reason if it is left out, else "".
  std::string add(const AbaqusCondition& c) {
    if (c.step > 1) return "belongs to a later step; only the first step is converted";
    if (c.step == 0 && replaced_.contains(c.keyword.name)) return "the first step removes it (OP=NEW)";
    for (const auto& [name, value] : c.keyword.parameters) {
      const bool is_plain = name == "OP" || name == "AMPLITUDE" ||
                            (name == "TYPE" && abaqus_word(value) == "DISPLACEMENT") ||
                            (name == "FOLLOWER" && abaqus_word(value) == "NO");
      if (!is_plain) return fmt::format("the parameter {} is not supported", name);
    }
    if (c.fields.empty()) return "has no values after the name of the set";
    if (std::string why = factors_.problem(c); !why.empty()) return why;
    if (c.keyword.name == "BOUNDARY") return add_support(c);
    if (c.keyword.name == "CLOAD") return add_force(c);
    if (c.keyword.name == "DSLOAD") return add_surface_load(c);
    return abaqus_word(c.fields[0]) == "GRAV" ? add_gravity(c) : add_face_load(c);
  }

  // Name in the mesh of a condition's node set or surface; nullopt if the mesh does not have it.
  template <class Thing>
  std::optional<std::string> name_of_target(const AbaqusCondition& c, const std::map<std::string, Thing>& things,
                                            const auto& in_mesh) const {
    const Thing* found = find_abaqus(things, c.target);
    if (!found || !in_mesh.contains(found->name)) return std::nullopt;
    return found->name;
  }
  std::optional<std::string> node_set(const AbaqusCondition& c) const {
    return name_of_target(c, deck_.node_sets, loaded_.mesh.node_sets);
  }
  std::optional<std::string> surface(const AbaqusCondition& c) const {
    return name_of_target(c, deck_.surfaces, loaded_.mesh.surfaces);
  }

  // Value of a field, `absent` if empty; nullopt if it is not a number.
  static std::optional<double> number(const AbaqusCondition& c, std::size_t field, double absent = 0) {
    if (field >= c.fields.size() || c.fields[field].empty()) return absent;
    return abaqus_number(c.fields[field]);
  }

  // Converts a *BOUNDARY line: first component, last component and value, or the name of a boundary condition.
  std::string add_support(const AbaqusCondition& c) {
    const auto set = node_set(c);
    if (!set) return "the mesh has no such nodes";
    if (const auto named = named_supports().find(abaqus_word(c.fields[0])); named != named_supports().end()) {
      for (const std::size_t k : named->second) support(*set, c).displacement[k] = Move{0, &c};
      return "";
    }
    const auto first = number(c, 0), last = number(c, 1, first.value_or(0)), value = number(c, 2);
    if (!first || !last || !value) return "components or value are not numbers";
    if (*first < 1 || *last < *first || *last > 6) return "the numbers of components are not from 1 to 6";
    if (*first > 3) return "prescribes rotations, which nodes of solids do not have";
    for (std::size_t k = static_cast<std::size_t>(*first);
         k <= std::min<std::size_t>(3, static_cast<std::size_t>(*last)); ++k)
      support(*set, c).displacement[k - 1] = Move{*value * units_.length, &c};
    return "";
  }

  struct Move {
    double value;  // m
    const AbaqusCondition* line;
  };
  struct Support {
    std::string set;
    std::array<std::optional<Move>, 3> displacement = {};
    std::vector<const AbaqusCondition*> lines = {};

    bool holds_all() const {
      return std::all_of(displacement.begin(), displacement.end(), [](const auto& d) { return d && d->value == 0; });
    }
  };

  // The support of a set, created if needed; registers the line with it.
  Support& support(const std::string& set, const AbaqusCondition& line) {
    auto found = std::find_if(supports_.begin(), supports_.end(), [&](const Support& s) { return s.set == set; });
    if (found == supports_.end()) found = supports_.emplace(found, Support{.set = set});
    if (found->lines.empty() || found->lines.back() != &line) found->lines.push_back(&line);
    return *found;
  }

  // Which *TRANSFORM rotates the directions at nodes of a set; "" if none.
  std::string rotated(const std::string& set) const { return rotated_.reason(loaded_.mesh.node_sets.at(set)); }

  void add_supports() {
    for (const Support& s : supports_) {
      // If all three components are fixed, their directions do not matter.
      if (const std::string why = rotated(s.set); !why.empty() && !s.holds_all())
        for (const AbaqusCondition* line : s.lines) leave_out(*line, why);
      else add_support(s);
    }
  }

  void add_support(const Support& s) {
    std::vector<std::size_t> held;
    std::map<std::string, std::vector<std::size_t>> moved;  // moved components by factor; "" without amplitude
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto& d = s.displacement[k]) (d->value == 0 ? held : moved[factors_.take(*d->line)]).push_back(k);
    if (!held.empty()) out_.clamps.push_back(fmt::format("{{nodes: {}{}}}", yaml_name(s.set), components_yaml(held)));
    for (const auto& [factor, components] : moved) add_motion(s, components, factor);
  }

  void add_motion(const Support& s, const std::vector<std::size_t>& components, const std::string& factor) {
    Vec3 translation = Vec3::Zero();
    for (const std::size_t k : components) translation[static_cast<Eigen::Index>(k)] = s.displacement[k]->value;
    const std::string own = is_static_ ? "{type: constant}" : "{type: smooth_step, end: 1}";
    const bool has_corners = !factor.empty() && !is_static_;
    out_.motions.push_back(fmt::format("{{nodes: {}{}, translation: {}, factor: {}}}{}", yaml_name(s.set),
                                       components_yaml(components), Value<Vec3>::yaml(translation),
                                       factor.empty() ? own : factor,
                                       has_corners ? "   # Abaqus/Standard rounds the corners (SMOOTH=0.25)" : ""));
  }

  // Converts a *CLOAD line: a force on each node of a set.
  std::string add_force(const AbaqusCondition& c) {
    const auto set = node_set(c);
    if (!set) return "the mesh has no such nodes";
    const auto component = number(c, 0), value = number(c, 1);
    if (!component || !value || *component < 1) return "component or value is not a number";
    if (*component > 3) return "is a moment, but nodes of solids have no rotations";
    if (std::string why = rotated(*set); !why.empty()) return why;
    const std::string factor = factors_.take(c);
    auto found = std::find_if(forces_.begin(), forces_.end(),
                              [&](const Force& f) { return f.set == *set && f.factor == factor; });
    if (found == forces_.end()) found = forces_.emplace(found, Force{*set, factor});
    found->vector[static_cast<Eigen::Index>(*component) - 1] += *value;
    return "";
  }

  struct Force {
    std::string set, factor;
    Vec3 vector = Vec3::Zero();  // N, on each node
  };

  void add_forces() {
    for (const auto& [set, factor, force] : forces_) {
      const auto count = loaded_.mesh.node_sets.at(set).size();
      out_.terms.push_back(fmt::format("{{type: point_load, nodes: {}, force: {}{}}}{}", yaml_name(set),
                                       Value<Vec3>::yaml(static_cast<double>(count) * force), entry(factor),
                                       count == 1 ? "" : fmt::format("   # total of {} nodes", count)));
    }
  }

  static std::string entry(const std::string& factor) { return factor.empty() ? "" : ", factor: " + factor; }

  std::string add_pressure(const AbaqusCondition& c) {
    const auto name = surface(c);
    const auto value = number(c, 1);
    if (!name) return "the mesh has no such surface";
    if (!value) return "the pressure is not a number";
    out_.terms.push_back(fmt::format("{{type: pressure, surface: {}, pressure: {}{}}}", yaml_name(*name),
                                     number_text(*value * units_.stress), entry(factors_.take(c))));
    return "";
  }

  std::string add_surface_load(const AbaqusCondition& c) {
    const std::string label = abaqus_word(c.fields[0]);
    if (label == "P") return add_pressure(c);
    if (label != "TRVEC") return fmt::format("loads of type {} are not supported", label);
    const auto name = surface(c);
    const auto traction = directed(c);
    if (!name) return "the mesh has no such surface";
    if (!is_linear() && !c.keyword.has("FOLLOWER"))
      return "follower tractions are not supported (FOLLOWER=YES is the default)";
    if (!traction) return "the traction needs a magnitude and a direction";
    out_.loads.push_back(fmt::format("{{surface: {}, traction: {}{}}}", yaml_name(*name),
                                     Value<Vec3>::yaml(units_.stress * *traction), entry(factors_.take(c))));
    return "";
  }

  std::string add_face_load(const AbaqusCondition& c) {
    const std::string label = abaqus_word(c.fields[0]);
    if (label.size() == 2 && label[0] == 'P' && std::isdigit(static_cast<unsigned char>(label[1])))
      return add_pressure(c);
    return fmt::format("loads of type {} are not supported", label);
  }

  std::string add_gravity(const AbaqusCondition& c) {
    if (c.keyword.has("AMPLITUDE")) return "gravity cannot vary in time";
    if (!covers_body(c)) return "gravity on a part of the body only is not supported";
    const auto g = directed(c);
    if (!g) return "the acceleration needs a magnitude and a direction";
    gravity_ += *g;
    return "";
  }

  // Vector from a magnitude and the components of a direction.
  static std::optional<Vec3> directed(const AbaqusCondition& c) {
    const auto size = number(c, 1), x = number(c, 2), y = number(c, 3), z = number(c, 4);
    if (!size || !x || !y || !z || Vec3(*x, *y, *z).norm() == 0) return std::nullopt;
    return *size * Vec3(*x, *y, *z).normalized();
  }

  bool covers_body(const AbaqusCondition& c) const {
    if (c.target.empty()) return true;
    const std::set<std::int64_t> found = solids_of_set(deck_, c.target);
    return std::all_of(deck_.draft.cells.begin(), deck_.draft.cells.end(),
                       [&](const FileCell& cell) { return found.contains(cell.tag); });
  }

  void leave_out(const AbaqusCondition& c, const std::string& why) {
    left_out_[{c.keyword.spelled, why}].push_back(c.place.line);
  }

  static std::string shortened(const std::vector<int>& lines) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < std::min<std::size_t>(5, lines.size()); ++k) names.push_back(std::to_string(lines[k]));
    if (lines.size() > 5) names.push_back(fmt::format("and {} more", lines.size() - 5));
    return join(names);
  }

  const AbaqusFile& deck_;
  const LoadedMesh& loaded_;
  UnitFactors units_;
  bool is_static_;
  AbaqusFactors factors_{deck_.amplitudes};
  AbaqusRotatedNodes rotated_{deck_, loaded_.mesh};
  std::set<std::string> replaced_;
  std::vector<Support> supports_;
  std::vector<Force> forces_;
  Vec3 gravity_ = Vec3::Zero();
  std::map<std::pair<std::string, std::string>, std::vector<int>> left_out_;
  SceneConditions out_;
};

}  // namespace

SceneConditions conditions_of(const AbaqusFile& deck, const LoadedMesh& loaded, const AbaqusSceneOptions& options) {
  return ConditionWriter(deck, loaded, options).write();
}

std::string yaml_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  if (!name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
      std::all_of(name.begin(), name.end(), plain))
    return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return quoted + "\"";
}

}  // namespace orthodyn
