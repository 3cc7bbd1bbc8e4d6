// Extremes of stress and strain fields over the nodes of a region.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/spelling.h"
#include "lib/fem/element_mesh.h"
#include "lib/fem/fem_model.h"
#include "lib/fem/nodal_fields.h"
#include "lib/scene/quantity.h"

namespace orthodyn {

namespace {

// `field`: FIELD or REGION.FIELD.
bool needs_strength(const std::string& field) {
  const auto& all = derived_fields();
  return std::any_of(all.begin(), all.end(), [&](const auto& f) {
    return f.needs_strength && (f.name == field || field.ends_with(std::string(".") + f.name));
  });
}

// The region of REGION.FIELD; "" for a field of the whole body.
std::string region_of(const std::string& field, const FemModel& model) {
  std::string longest;
  for (const FieldRegion& region : field_regions(model.parts().elastic))
    if (field.starts_with(region.name + ".") && region.name.size() > longest.size()) longest = region.name;
  return longest;
}

// A component of a field of one region, or of the whole body if `region` is "".
struct FieldOfRegion {
  std::string region, field;
  std::size_t component = 0, components = 1;

  std::string name() const { return region.empty() ? field : region + "." + field; }
};

// The whole body (""), the mesh's regions, and plies.
std::vector<std::string> region_names(const FemModel& model) {
  std::vector<std::string> names{""};
  for (const auto& term : model.parts().elastic)
    for (const std::string& name : {term->definition().mesh_region, term->definition().ply,
                                    term->definition().stiffness_cell < 0 ? term->region() : ""})
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

// Whether a term belongs to the region or ply of this name.
bool is_of(const ElasticTerm& term, const std::string& region) {
  const ElasticRegion& own = term.definition();
  return region == own.name || region == own.mesh_region || region == own.ply;
}

std::optional<FieldOfRegion> read_field(const std::string& name, const FemModel& model) {
  for (const std::string& region : region_names(model))
    for (const OutputInfo& info : region_fields()) {
      FieldOfRegion found{region, info.name, 0, static_cast<std::size_t>(info.components)};
      if (info.component_names.empty() && name == found.name()) return found;
      for (std::size_t c = 0; c < info.component_names.size(); ++c)
        if (name == found.name() + "." + info.component_names[c]) return found.component = c, found;
    }
  return std::nullopt;
}

struct FieldOfTerm {
  std::string name;
  int term;  // as in Extreme
};

// The field in each region or ply. A field of the whole body is evaluated region by region, because its value
// at a node of several regions is a mean, which would hide a thin layer.
std::vector<FieldOfTerm> fields_of_terms(const FieldOfRegion& field, const FemModel& model) {
  const auto& terms = model.parts().elastic;
  if (terms.size() == 1 && field.region.empty()) return {{field.name(), -1}};
  std::vector<FieldOfTerm> fields;
  for (std::size_t k = 0; k < terms.size(); ++k)
    if (field.region.empty() || is_of(*terms[k], field.region))
      fields.push_back({terms[k]->region() + "." + field.field, terms.size() == 1 ? -1 : static_cast<int>(k)});
  return fields;
}

// Updates the extreme. `sign`: 1 for the largest, -1 for the smallest.
void update_extreme(const std::vector<double>& values, const FieldOfRegion& field, double sign, int term,
                    Extreme& extreme) {
  for (std::size_t k = field.component; k < values.size(); k += field.components) {
    if (std::isnan(values[k]) || !(extreme.node < 0 || sign * values[k] > sign * extreme.value)) continue;
    extreme = {values[k], static_cast<int>(k / field.components), term};
  }
}

// Whether an element of the term has the node, on any rank. Collective.
bool has_node(const FemModel& model, const ElementMesh& mesh, const ElasticTerm& term, int node) {
  const auto& own = model.ranks() ? term.definition().numbers : term.definition().cells;
  return model.space().any(std::any_of(own.begin(), own.end(), [&](int cell) {
    const auto nodes = mesh.cells[static_cast<std::size_t>(cell)];
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }));
}

// The elastic terms of the region, or of the whole body if it is "", that have the node. Collective.
std::vector<const ElasticTerm*> terms_at(int node, const std::string& region, const ElementMesh& mesh,
                                         const FemModel& model) {
  std::vector<const ElasticTerm*> terms;
  for (const auto& term : model.parts().elastic)
    if ((region.empty() || is_of(*term, region)) && has_node(model, mesh, *term, node)) terms.push_back(term.get());
  return terms;
}

// Throws ConfigError if `name` is an extreme of a known field in an unknown region.
void refuse_unknown_region(const std::string& name, const FemModel& model, const SourceLocation& origin) {
  std::vector<std::string> known = region_names(model);
  known.erase(known.begin());  // the whole body
  for (const OutputInfo& info : region_fields()) {
    const auto begin = name.find("." + info.name + ".");
    if (begin == std::string::npos) continue;
    const std::string region = name.substr(0, begin);
    if (std::find(known.begin(), known.end(), region) == known.end())
      origin.fail(fmt::format("'{}': no region or ply '{}'{} There are {}", name, region,
                              did_you_mean(region, known, "."), join(known)));
  }
}

void fail_without_strength(const std::string& field, const std::string& what, const SourceLocation& origin) {
  origin.fail(
      fmt::format("'{}' needs the strengths of {}: add strength: {{tension: [...], compression: [...], shear: [...]}} "
                  "(Pa) to it, or use a preset with strengths (`orthodyn list presets`)",
                  field, what));
}

}  // namespace

void require_strengths(const std::string& field, const std::string& region, const FemModel& model,
                       const SourceLocation& origin) {
  if (!needs_strength(field)) return;
  const std::string named = region_of(field, model), wanted = named.empty() ? region : named;
  for (const auto& term : model.parts().elastic)
    if ((wanted.empty() || is_of(*term, wanted)) && term->definition().strength) return;
  fail_without_strength(field, wanted.empty() ? "a material" : "the material of region " + wanted, origin);
}

void require_field_at(const std::string& field, int node, const FemModel& model, const SourceLocation& origin) {
  const std::string named = region_of(field, model);
  if (named.empty() && !needs_strength(field)) return;
  const ElementMesh mesh(model.parts().mesh);
  const std::vector<const ElasticTerm*> terms = terms_at(node, named, mesh, model);
  if (!named.empty() && terms.empty())
    origin.fail(
        fmt::format("'{}': the probe's node is not in region {}; move the probe, give it a `region`, or use the field "
                    "without a region",
                    field, named));
  if (!needs_strength(field)) return;
  for (const ElasticTerm* term : terms)
    if (term->definition().strength) return;
  fail_without_strength(field, terms.empty() ? "a material" : "the material of region " + terms.back()->region(),
                        origin);
}

std::string unit_of_extreme(const std::string& name) {
  for (const OutputInfo& info : region_fields())
    if (name.starts_with(info.name + ".") || name.find("." + info.name + ".") != std::string::npos)
      return info.unit == "1" ? "" : info.unit;
  return "";
}

std::optional<FindExtreme> find_extreme(const std::string& name, const FemModel& model, const SourceLocation& origin) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string which = name.substr(dot + 1);
  if (which != "largest" && which != "smallest") return std::nullopt;
  const auto field = read_field(name.substr(0, dot), model);
  if (!field) {
    refuse_unknown_region(name, model, origin);
    return std::nullopt;
  }
  require_strengths(field->field, field->region, model, origin);
  const double sign = which == "largest" ? 1 : -1;
  return [fields = fields_of_terms(*field, model), field = *field, sign](const ObservedState& observed) {
    Extreme extreme{std::numeric_limits<double>::quiet_NaN(), -1};
    for (const FieldOfTerm& own : fields) update_extreme(observed.evaluate(own.name), field, sign, own.term, extreme);
    return extreme;
  };
}

}  // namespace orthodyn
