#include "lib/study/compare/comparison_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/simulation/run/machine.h"
#include "lib/study/compare/reference_error.h"
#include "lib/study/compare/work_precision.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::compare {

namespace {

Json set_json(const Assignments& set, const std::string& prefix = "") {
  Json out = Json::object();
  for (const auto& [path, value] : set) out[prefix + path] = value.text;
  return out;
}

template <class T>
Json json_or_null(const std::optional<T>& x) {
  return x ? to_json(*x) : Json();
}

Json message_of(const std::optional<Failure>& failure) { return failure ? Json(failure->message) : Json(); }

Json no_reference(const std::string& method, const Json& message) {
  return {{"kind", "none"}, {"method", method}, {"message", message}, {"checked", false}};
}

// `wanted`: the comparison requests references. `own_mesh`: the reference has another mesh than the points.
Json reference_json(const Reference* reference, bool wanted, bool own_mesh) {
  if (!reference) return no_reference("", wanted ? "not computed yet" : "no reference was requested");
  const MeasurementResult& result = reference->result;
  if (reference->folder.empty()) return no_reference(reference->method, message_of(result.failure));
  const bool exact = is_exact(*reference);
  const auto errors = time_errors_of(reference);
  return {{"kind", exact ? "exact" : "computed"},
          {"method", exact ? "exact solution by modes" : reference->method},
          {"check", exact ? Json() : Json(reference->check_method)},
          {"checked", errors.has_value()},
          {"seconds", optional_json(result.seconds)},
          {"message", reference->check ? message_of(reference->check->failure) : Json()},
          {"errors", json_or_null(errors)},
          {own_mesh ? "mesh_error" : "shared_mesh_error", optional_json(result.mesh_error)},
          {"unknowns", member(to_json(result).at("model"), "unknowns")},
          {"folder", reference->folder}};
}

Json scales_json(const Json& scales, bool at_probes) {
  if (!scales.is_object()) return nullptr;
  return {{"displacement", scales.at("displacement")},
          {"velocity", scales.at("velocity")},
          {"words",
           std::string("largest displacement from the rest shape, and largest velocity, of the reference over time, ") +
               (at_probes ? "root mean square over the probes" : "in the mass norm")}};
}

Json problem_json(const Design& design, const Problem& problem, const Reference* reference, bool wanted,
                  const Json& model) {
  const Json scales = reference ? json_or_null(reference->result.scales) : Json();
  return {{"id", problem.id},
          {"label", problem.label},
          {"group", design.groups[problem.group].id},
          {"mesh", problem.mesh},
          {"scene", problem.scene.file},
          {"set", set_json(problem.scene.set)},
          {"sentence", head_comment(problem.scene.text)},
          {"unknowns", member(model, "unknowns")},
          {"elements", member(model, "elements")},
          {"nodes", member(model, "nodes")},
          {"order", member(model, "order")},
          {"time", {{"start", member(model, "start")}, {"end", member(model, "end")}}},
          {"scales", scales_json(scales, design.across_meshes)},
          {"probe_scales", member(scales, "probes")},
          {"quantity_scales", member(scales, "quantities")},
          {"dominant_frequency", member(scales, "dominant_frequency")},
          {"reference", reference_json(reference, wanted, design.across_meshes)}};
}

Json method_json(const Method& method) {
  return {{"id", method.id},
          {"label", method.label},
          {"integrator", method.integrator},
          {"sentence", method.sentence},
          {"set", set_json(method.set, "integrator.")},
          {"control", control_word(method.control)}};
}

// Names of the errors that are not well above the reference's own error; all names if the reference's error is unknown.
Json near_reference(const std::optional<TrajectoryErrors>& errors, const std::optional<TrajectoryErrors>& of_reference,
                    const ReferenceFloor& floor) {
  Json out = Json::array();
  if (!errors) return out;
  const Json measured = to_json(*errors), reference = json_or_null(of_reference);
  const auto check = [&](const Json& norms, const Json& reference_norms, const std::string& name) {
    for (const std::string norm : {"final", "l2", "max"})
      if (floor.covers(number_or_nan(norms.at(norm)), number_or_nan(member(reference_norms, norm))))
        out.push_back(name + "." + norm);
  };
  for (const std::string field : {"displacement", "velocity"})
    check(measured.at(field), member(reference, field), field);
  for (const std::string list : {"probes", "quantities"})
    for (const auto& [name, norms] : measured.at(list).items())
      check(norms, member(member(reference, list), name), list + "." + name);
  return out;
}

Json point_json(const ComparisonRun& run, std::size_t index, const MeasurementResult& result,
                const Reference* reference) {
  const Point& point = run.design().points[index];
  const Method& method = run.design().methods[point.method];
  const Json measured = to_json(result);
  Json out{{"problem", run.design().problems[point.problem].id},
           {"method", method.id},
           {"control", {{"kind", control_word(method.control)}, {"value", point.control}}},
           {"status", measured.at("status")}};
  for (const char* key : {"reason", "message"}) out[key] = member(measured, key);
  for (const auto& key : point_fields().keys()) out[key] = member(measured, key);
  out["near_reference"] =
      near_reference(result.errors, time_errors_of(reference), ReferenceFloor(reference, run.design().across_meshes));
  out["scene"] = run.point_folder(index) + "/scene.yaml";
  return out;
}

const Reference* reference_of(const ComparisonRun& run, std::size_t problem) {
  const auto found = run.references().find(run.design().problems[problem].group);
  return found == run.references().end() ? nullptr : &found->second;
}

// Time error of the reference; NaN if unknown.
double reference_error(const ComparisonRun& run, std::size_t problem) {
  const auto errors = time_errors_of(reference_of(run, problem));
  return errors ? errors->displacement.l2 : std::numeric_limits<double>::quiet_NaN();
}

// The finished points of a method on a problem, from loose to tight.
std::vector<WorkPoint> work_points(const ComparisonRun& run, std::size_t problem, std::size_t method) {
  std::vector<WorkPoint> out;
  const ReferenceFloor floor(reference_of(run, problem), false);
  for (const auto& [index, result] : run.results()) {
    const Point& point = run.design().points[index];
    if (point.problem != problem || point.method != method || result.failure) continue;
    if (!result.errors || !result.wall || !std::isfinite(result.errors->displacement.l2)) continue;
    const double error = result.errors->displacement.l2;
    out.push_back({point.control, error, result.wall->median, !floor.covers(error, reference_error(run, problem))});
  }
  return out;
}

Json answer_json(const ComparisonRun& run, std::size_t problem, double target) {
  const Design& design = run.design();
  Json rows = Json::array();
  for (std::size_t m = 0; m < design.methods.size(); ++m) {
    const auto work = work_points(run, problem, m);
    Json row{{"method", design.methods[m].id}, {"seconds", nullptr}};
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
  return {{"problem", design.problems[problem].id}, {"error", kLeadingError}, {"target", target}, {"methods", rows}};
}

void add_conclusions(const ComparisonRun& run, Json& out) {
  const Design& design = run.design();
  out["answers"] = Json::array();
  out["orders"] = Json::array();
  out["pareto_fronts"] = pareto_fronts_json(run, out);
  if (design.across_meshes) return;  // errors include the mesh error, so methods show no order in time
  for (std::size_t p = 0; p < design.problems.size(); ++p) {
    std::vector<WorkPoint> all;
    for (std::size_t m = 0; m < design.methods.size(); ++m) {
      const auto work = work_points(run, p, m);
      all.insert(all.end(), work.begin(), work.end());
      if (const auto fit = slope(work))
        out["orders"].push_back({{"problem", design.problems[p].id},
                                 {"method", design.methods[m].id},
                                 {"error", kLeadingError},
                                 {"slope", fit->value},
                                 {"points", fit->points},
                                 {"from", fit->from},
                                 {"to", fit->to}});
    }
    const double bound = reference_error(run, p);
    if (std::isnan(bound)) continue;
    for (const double target : targets(all, ReferenceFloor(reference_of(run, p), false).at(bound)))
      out["answers"].push_back(answer_json(run, p, target));
  }
}

// Time of day of the oldest measurement; null without any.
Json first_measured(const ComparisonRun& run) {
  Json first;
  for (const auto& [index, result] : run.results())
    if (!result.at.empty() && (first.is_null() || result.at < first.get<std::string>())) first = result.at;
  return first;
}

}  // namespace

Json comparison_json(const ComparisonRun& run, const std::string& file) {
  const auto& comparison = run.comparison();
  const auto& design = run.design();
  Json out{{"orthodyn_comparison", 1},
           {"name", comparison.name},
           {"title", comparison.title},
           {"description", comparison.description},
           {"file", file},
           {"started", first_measured(run)},
           {"complete", run.results().size() == design.points.size()},
           {"planned_points", design.points.size()},
           {"machine", machine_json()},
           {"versions", versions_json()},
           {"settings",
            {{"repeats", comparison.repeats},
             {"samples", comparison.samples},
             {"ranks", run.ranks()},
             {"limit_seconds", comparison.limits.seconds},
             {"limit_memory_bytes", comparison.limits.memory}}},
           {"problems", Json::array()},
           {"methods", Json::array()},
           {"points", Json::array()}};
  const bool wanted = comparison.reference.kind != ReferenceKind::none;
  for (const auto& method : design.methods) out["methods"].push_back(method_json(method));
  for (std::size_t p = 0; p < design.problems.size(); ++p) {
    const Reference* reference = reference_of(run, p);
    Json model = reference && !design.across_meshes ? member(to_json(reference->result), "model") : Json();
    for (const auto& [index, result] : run.results()) {
      if (design.points[index].problem != p) continue;
      if (model.is_null()) model = member(to_json(result), "model");
      out["points"].push_back(point_json(run, index, result, reference));
    }
    out["problems"].push_back(problem_json(design, design.problems[p], reference, wanted, model));
  }
  add_conclusions(run, out);
  return out;
}

}  // namespace orthodyn::study::compare
