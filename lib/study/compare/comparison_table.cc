#include "lib/study/compare/comparison_table.h"

#include <algorithm>
#include <limits>

#include "lib/study/compare/answers.h"
#include "lib/simulation/machine.h"

namespace orthodyn {

namespace {

// A point this close to the reference's own error cannot be told from it.
constexpr double kResolution = 10;
constexpr const char* kNorms[] = {"final", "l2", "max"};

Json set_json(const Assignments& set, const std::string& prefix = "") {
  Json out = Json::object();
  for (const auto& [path, value] : set) out[prefix + path] = value.text;
  return out;
}

Json field(const Json& object, const std::string& key) {
  return object.is_object() && object.contains(key) ? object.at(key) : Json();
}

Json no_reference(const std::string& method, const Json& message) {
  return {{"kind", "none"}, {"method", method}, {"message", message}, {"checked", false}};
}

// `wanted`: the comparison asks for references.
Json reference_json(const ReferenceResult* reference, bool wanted) {
  if (!reference) return no_reference("", wanted ? "not computed yet" : "no reference was asked for");
  const Json& result = reference->result;
  if (reference->folder.empty()) return no_reference(reference->method, field(result, "message"));
  const bool exact = result.at("kind") == "exact";
  const Json errors = exact ? field(result, "own_errors") : field(reference->check, "errors");
  return {{"kind", exact ? "exact" : "computed"},
          {"method", exact ? "exact solution by modes" : reference->method},
          {"check", exact ? Json() : Json(reference->check_method)},
          {"checked", errors.is_object()},
          {"seconds", field(result, "seconds")},
          {"message", field(reference->check, "message")},
          {"errors", errors},
          {"folder", reference->folder}};
}

Json scales_json(const Json& scales) {
  if (!scales.is_object()) return nullptr;
  return {{"displacement", scales.at("displacement")},
          {"velocity", scales.at("velocity")},
          {"words", "largest displacement from the rest shape, resp. velocity, of the reference over time, in the mass "
                    "norm"}};
}

Json problem_json(const Problem& problem, const ReferenceResult* reference, bool wanted, const Json& model) {
  const Json scales = reference ? field(reference->result, "scales") : Json();
  return {{"id", problem.id},
          {"label", problem.label},
          {"scene", problem.file},
          {"set", set_json(problem.set)},
          {"sentence", head_comment(problem.text)},
          {"unknowns", field(model, "unknowns")},
          {"elements", field(model, "elements")},
          {"nodes", field(model, "nodes")},
          {"time", {{"start", field(model, "start")}, {"end", field(model, "end")}}},
          {"scales", scales_json(scales)},
          {"probe_scales", field(scales, "probes")},
          {"dominant_frequency", field(scales, "dominant_frequency")},
          {"reference", reference_json(reference, wanted)}};
}

Json method_json(const Method& method) {
  return {{"id", method.id},
          {"label", method.label},
          {"integrator", method.integrator},
          {"sentence", method.sentence},
          {"set", set_json(method.set, "integrator.")},
          {"control", control_word(method.control)}};
}

// The names of the errors that are within a factor of ten of the reference's own; all, if that is not known.
Json near_reference(const Json& errors, const Json& of_reference) {
  Json out = Json::array();
  if (!errors.is_object()) return out;
  const auto look = [&](const Json& a, const Json& b, const std::string& prefix) {
    for (const char* norm : kNorms) {
      const Json own = field(b, norm);
      if (a.at(norm).is_number() && (!own.is_number() || a.at(norm).get<double>() < kResolution * own.get<double>()))
        out.push_back(prefix + "." + norm);
    }
  };
  for (const char* kind : {"displacement", "velocity"}) look(errors.at(kind), field(of_reference, kind), kind);
  for (const auto& [name, e] : errors.at("probes").items())
    look(e, field(field(of_reference, "probes"), name), "probes." + name);
  return out;
}

Json point_json(const Campaign& campaign, std::size_t index, const Json& result, const Json& reference) {
  const Point& point = campaign.design().points[index];
  const Method& method = campaign.design().methods[point.method];
  Json out{{"problem", campaign.design().problems[point.problem].id},
           {"method", method.id},
           {"control", {{"kind", control_word(method.control)}, {"value", point.control}}},
           {"status", result.at("status")}};
  for (const char* key : {"reason", "message", "time_reached", "repeats", "wall", "cpu", "statistics",
                          "peak_memory_bytes", "factor_bytes", "errors", "drift", "drift_over_time",
                          "smallest_det_f", "decisions"})
    out[key] = field(result, key);
  out["near_reference"] = near_reference(out["errors"], field(reference, "errors"));
  out["scene"] = campaign.point_folder(index) + "/scene.yaml";
  return out;
}

// The finished points of a method on a problem, from loose to tight.
std::vector<WorkPoint> work_points(const Json& points, const Json& problem, const Json& method) {
  std::vector<WorkPoint> out;
  for (const auto& point : points) {
    if (point.at("problem") != problem || point.at("method") != method || point.at("status") != "completed") continue;
    if (!point.at("errors").is_object() || !point.at("wall").is_object()) continue;
    const Json error = point.at("errors").at("displacement").at("l2");
    if (!error.is_number()) continue;
    out.push_back({point.at("control").at("value"), error, point.at("wall").at("median"),
                   !is_near_reference(point, kLeadingError)});
  }
  return out;
}

// Infinite if it is not known: then there is nothing to conclude.
double reference_error(const Json& problem) {
  const Json error = field(field(field(problem.at("reference"), "errors"), "displacement"), "l2");
  return error.is_number() ? error.get<double>() : std::numeric_limits<double>::infinity();
}

Json answer_json(const Json& problem, double target, const Json& methods, const Json& points) {
  Json rows = Json::array();
  for (const auto& method : methods) {
    const auto work = work_points(points, problem.at("id"), method.at("id"));
    Json row{{"method", method.at("id")}, {"seconds", nullptr}};
    if (const auto seconds = seconds_to_reach(target, work)) row["seconds"] = *seconds;
    else if (!work.empty())
      row["best_error"] = std::min_element(work.begin(), work.end(), [](const auto& a, const auto& b) {
                            return a.error < b.error;
                          })->error;
    rows.push_back(row);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
    if (a.at("seconds").is_null() || b.at("seconds").is_null()) return !a.at("seconds").is_null();
    return a.at("seconds").get<double>() < b.at("seconds").get<double>();
  });
  return {{"problem", problem.at("id")}, {"error", kLeadingError}, {"target", target}, {"methods", rows}};
}

void add_conclusions(Json& out) {
  out["answers"] = Json::array();
  out["orders"] = Json::array();
  for (const auto& problem : out.at("problems")) {
    std::vector<WorkPoint> all;
    for (const auto& method : out.at("methods")) {
      const auto work = work_points(out.at("points"), problem.at("id"), method.at("id"));
      all.insert(all.end(), work.begin(), work.end());
      if (const auto fit = slope(work))
        out["orders"].push_back({{"problem", problem.at("id")},
                                 {"method", method.at("id")},
                                 {"error", kLeadingError},
                                 {"slope", fit->value},
                                 {"points", fit->points},
                                 {"from", fit->from},
                                 {"to", fit->to}});
    }
    for (const double target : targets(all, kResolution * reference_error(problem)))
      out["answers"].push_back(answer_json(problem, target, out.at("methods"), out.at("points")));
  }
}

}  // namespace

namespace {

// When the oldest of the points was measured; null without any.
Json first_measured(const Campaign& campaign) {
  Json first;
  for (const auto& [index, result] : campaign.results()) {
    const Json at = field(result, "at");
    if (at.is_string() && (first.is_null() || at.get<std::string>() < first.get<std::string>())) first = at;
  }
  return first;
}

}  // namespace

bool is_near_reference(const Json& point, const std::string& error) {
  const Json& names = point.at("near_reference");
  return std::any_of(names.begin(), names.end(), [&](const Json& n) { return n.get<std::string>() == error; });
}

Json comparison_json(const Campaign& campaign, const std::string& file) {
  const auto& comparison = campaign.comparison();
  const auto& design = campaign.design();
  Json out{{"orthodyn_comparison", 1},
           {"name", comparison.name},
           {"title", comparison.title},
           {"description", comparison.description},
           {"file", file},
           {"started", first_measured(campaign)},
           {"complete", campaign.results().size() == design.points.size()},
           {"planned_points", design.points.size()},
           {"machine", machine_json()},
           {"versions", versions_json()},
           {"settings",
            {{"repeats", comparison.repeats},
             {"samples", comparison.samples},
             {"limit_seconds", comparison.limits.seconds},
             {"limit_memory_bytes", comparison.limits.memory}}},
           {"problems", Json::array()},
           {"methods", Json::array()},
           {"points", Json::array()}};
  const bool wanted = comparison.reference.kind != ReferenceKind::none;
  for (const auto& method : design.methods) out["methods"].push_back(method_json(method));
  for (std::size_t p = 0; p < design.problems.size(); ++p) {
    const auto found = campaign.references().find(p);
    const ReferenceResult* reference = found == campaign.references().end() ? nullptr : &found->second;
    Json model = reference ? field(reference->result, "model") : Json();
    Json points = Json::array();
    for (const auto& [index, result] : campaign.results()) {
      if (design.points[index].problem != p) continue;
      if (model.is_null()) model = field(result, "model");
      points.push_back(point_json(campaign, index, result, reference_json(reference, wanted)));
    }
    out["problems"].push_back(problem_json(design.problems[p], reference, wanted, model));
    out["points"].insert(out["points"].end(), points.begin(), points.end());
  }
  add_conclusions(out);
  return out;
}

}  // namespace orthodyn
