#include "lib/study/sweep/sweep_table.h"

#include <algorithm>
#include <utility>

#include "lib/core/units.h"
#include "lib/simulation/output/extremes.h"
#include "lib/simulation/run/machine.h"
#include "lib/study/jobs/json_values.h"
#include "lib/study/sweep/key_unit.h"

namespace orthodyn::study::sweep {

namespace {

// A variable without a unit gets the unit of its key in the first valid scene.
Json variables_json(const Sweep& sweep, const std::vector<Point>& points) {
  const auto first = std::find_if(points.begin(), points.end(), [](const auto& p) { return p.impossible.empty(); });
  Json all = Json::array();
  for (const auto& v : sweep.vary) {
    const bool is_plain = v.unit.empty() && v.numeric() && !v.path.empty() && first != points.end();
    all.push_back({{"name", v.name},
                   {"path", v.path},
                   {"unit", is_plain ? unit_at(v.path, Config::from_text(first->scene.scene)) : v.unit},
                   {"numeric", v.numeric()},
                   {"scale", Value<Scale>::yaml(v.scale)}});
  }
  return all;
}

// True if the metric is a value of a failure criterion, which means failure at 1; false for its time or frequency.
bool fails_at_one(const WantedMetric& m) {
  const bool is_value = m.take == TimeReduction::end || m.take == TimeReduction::max || m.take == TimeReduction::min ||
                        m.take == TimeReduction::mean;
  return is_failure_criterion(m.quantity) && is_value && !m.settled_within;
}

// `unit` is for display; `factor` converts it to SI.
Json metrics_json(const Sweep& sweep, const std::map<std::string, std::string>& units) {
  Json all = Json::array();
  for (const auto& [name, m] : sweep.quantities) {
    const auto found = units.find(name);
    const std::string si = found == units.end() ? "" : found->second;
    all.push_back({{"name", name},
                   {"title", m.title.empty() ? name : m.title},
                   {"unit", m.unit.empty() ? si : m.unit},
                   {"factor", m.unit.empty() ? 1 : si_factor(m.unit)},
                   {"scale", Value<Scale>::yaml(m.scale)},
                   {"closed_form", m.closed_form},
                   {"has_own_error", m.mode || m.along},
                   {"fails_at_one", fails_at_one(m)}});
  }
  return all;
}

Json plots_json(const Sweep& sweep) {
  Json all = Json::array();
  for (const auto& p : sweep.plots) all.push_back({{"metric", p.metric}, {"x", p.x}, {"lines", p.lines}});
  return all;
}

Json frames_json(const Sweep& sweep) {
  if (!sweep.frames) return nullptr;
  const FrameSpec& f = *sweep.frames;
  return {{"at", f.at ? Json(*f.at) : Json()},
          {"color", f.color},
          {"view", f.view},
          {"up", f.up},
          {"enlarged", f.enlarged},
          {"most", f.most},
          {"ghost", f.ghost}};
}

// Empty for a missing point.
std::optional<EvaluationResult> result_of(const Point& point, const std::optional<Job>& job, const Results& results) {
  if (!job) {
    EvaluationResult impossible;
    impossible.failure = Failure{kImpossible, point.impossible};
    return impossible;
  }
  const auto found = results.find(job->folder);
  return found == results.end() ? std::nullopt : std::optional(found->second);
}

Json point_json(const Sweep& sweep, const Point& point, const std::optional<Job>& job,
                const std::optional<EvaluationResult>& result) {
  const Json computed = result ? to_json(*result) : Json{{"status", kMissing}};
  Json out{{"title", point.title}, {"status", computed.at("status")}};
  out["folder"] = job ? "points/" + job->folder.filename().string() : "";
  for (std::size_t k = 0; k < sweep.vary.size(); ++k) {
    const VariedValue& value = point.values[k];
    out["values"][sweep.vary[k].name] = value.number ? Json(*value.number) : Json(value.label);
  }
  out["metrics"] = Json::object();
  out["metric_errors"] = Json::object();
  out["closed_forms"] = Json::object();
  for (std::size_t q = 0; q < sweep.quantities.size(); ++q) {
    const std::string& name = sweep.quantities[q].first;
    out["metrics"][name] = member(member(computed, "metrics"), name);
    out["metric_errors"][name] = member(member(computed, "metric_errors"), name);
    out["closed_forms"][name] = finite_or_null(point.closed_forms[q]);
  }
  for (const char* key : {"reason", "message", "cost", "model", "frame", "mesh_error", "warnings"})
    out[key] = member(computed, key);
  return out;
}

}  // namespace

Results results_of(const std::vector<Job>& jobs) {
  Results all;
  for (const auto& job : jobs)
    if (const Json result = read_result(job.folder); result.is_object())
      all.emplace(job.folder, evaluation_from(result));
  return all;
}

Json sweep_json(const Sweep& sweep, const std::vector<Point>& points, const std::vector<std::optional<Job>>& jobs,
                const Results& results, const std::string& file, int ranks) {
  Json rows = Json::array();
  std::map<std::string, std::string> units;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto result = result_of(points[i], jobs[i], results);
    if (result)
      for (const auto& [name, unit] : result->units) units[name] = unit;
    missing += !result;
    rows.push_back(point_json(sweep, points[i], jobs[i], result));
  }
  Json definitions = Json::object();
  for (const auto& [name, text] : sweep.definitions) definitions[name] = text.text;
  return {{"orthodyn_sweep", 1},
          {"name", sweep.name},
          {"title", sweep.title},
          {"description", sweep.description},
          {"combine", Value<Combine>::yaml(sweep.combine)},
          {"file", file},
          {"scene", sweep.scene.file.path},
          {"written", utc_now()},
          {"missing", missing},
          {"machine", machine_json()},
          {"ranks", ranks},
          {"versions", versions_json()},
          {"variables", variables_json(sweep, points)},
          {"metrics", metrics_json(sweep, units)},
          {"definitions", definitions},
          {"plots", plots_json(sweep)},
          {"frames", frames_json(sweep)},
          {"points", rows}};
}

namespace {

// A number in SI converted to the unit of which `factor` is the SI value; anything else unchanged.
Json divided(const Json& x, double factor) { return x.is_number() ? Json(x.get<double>() / factor) : x; }

Json difference(const Json& x, const Json& reference) {
  if (!x.is_number() || !reference.is_number() || reference == 0) return nullptr;
  return x.get<double>() / reference.get<double>() - 1;
}

constexpr std::pair<const char*, const char*> kCosts[] = {
    {"wall_seconds", "wall_seconds [s]"}, {"cpu_seconds", "cpu_seconds [s]"}, {"steps", "steps"}};

bool has_metric(const Json& table, const std::string& name) {
  const Json& metrics = table.at("metrics");
  return std::any_of(metrics.begin(), metrics.end(), [&](const Json& m) { return m.at("name") == name; });
}

std::string csv_head(const Json& table) {
  std::string out = "point";
  const auto add = [&](const Json& named, const char* ending = "") {
    out += "," + csv_cell(csv_heading(named.at("name").get<std::string>() + ending, named.at("unit")));
  };
  const auto add_number = [&](const Json& metric, const char* ending) {
    out += "," + csv_cell(metric.at("name").get<std::string>() + ending);
  };
  for (const auto& variable : table.at("variables")) add(variable);
  for (const auto& metric : table.at("metrics")) {
    add(metric);
    if (metric.at("has_own_error")) add_number(metric, ".mesh_error");
    if (metric.at("closed_form") == "") continue;
    add(metric, ".closed_form");
    add_number(metric, ".relative_difference");
  }
  out += ",status,reason,message";
  for (const auto& [cost, title] : kCosts)
    if (!has_metric(table, cost)) out += std::string(",") + title;
  return out + ",mesh_error,warnings,unknowns,folder\n";
}

Json joined(const Json& texts) {
  std::string out;
  for (const auto& text : texts) out += (out.empty() ? "" : "; ") + text.get<std::string>();
  return out.empty() ? Json() : Json(out);
}

std::string csv_row(const Json& table, const Json& point, std::size_t number) {
  std::string out = std::to_string(number);
  const auto add = [&](const Json& value) { out += "," + csv_cell(value); };
  for (const auto& v : table.at("variables")) add(point.at("values").at(v.at("name").get<std::string>()));
  for (const auto& m : table.at("metrics")) {
    const std::string name = m.at("name");
    const Json &value = point.at("metrics").at(name), &closed = point.at("closed_forms").at(name);
    add(divided(value, m.at("factor")));
    if (m.at("has_own_error")) add(point.at("metric_errors").at(name));
    if (m.at("closed_form") == "") continue;
    add(divided(closed, m.at("factor")));
    add(difference(value, closed));
  }
  for (const char* key : {"status", "reason", "message"}) add(point.at(key));
  for (const auto& [cost, title] : kCosts)
    if (!has_metric(table, cost)) add(member(point.at("cost"), cost));
  add(point.at("mesh_error"));
  add(joined(point.at("warnings")));
  add(member(point.at("model"), "unknowns"));
  add(point.at("folder"));
  return out + "\n";
}

}  // namespace

std::string sweep_csv(const Json& table) {
  std::string out = csv_head(table);
  std::size_t number = 0;
  for (const auto& point : table.at("points")) out += csv_row(table, point, ++number);
  return out;
}

}  // namespace orthodyn::study::sweep
