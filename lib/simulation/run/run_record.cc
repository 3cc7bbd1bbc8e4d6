#include "lib/simulation/run/run_record.h"

#include <cmath>

#include "lib/core/parallel.h"
#include "lib/simulation/error_estimate/error_balance.h"
#include "lib/simulation/run/machine.h"
#include "lib/simulation/run/result_warnings.h"

namespace orthodyn {

namespace {

Json json_of(const Config& value);

// Integers are written without a decimal point.
Json number_json(double x) {
  constexpr double kExact = 9e15;
  if (std::abs(x) < kExact && std::floor(x) == x) return static_cast<long>(x);
  return x;
}

Json scalar_json(const Config& value) {
  if (value.is_null()) return {};
  if (value.reads_as_number()) return number_json(value.number());
  const std::string text = value.text();
  if (text == "true" || text == "false") return text == "true";
  return text;
}

Json list_json(const Config& list) {
  Json out = Json::array();
  for (std::size_t k = 0; k < list.size(); ++k) out.push_back(json_of(list.at(k)));
  return out;
}

Json section_json(const Config& section) {
  Json out = Json::object();
  for (const auto& key : section.keys())
    if (Json value = json_of(section.at(key)); !value.is_null()) out[key] = std::move(value);
  return out;
}

Json json_of(const Config& value) {
  return value.is_map() ? section_json(value) : value.is_sequence() ? list_json(value) : scalar_json(value);
}

// The model sections of a resolved scene, key by key. Values are as in the input (SI, or text with a unit); sections
// without a value are omitted.
Json model_sections(const Config& resolved) {
  Json out = Json::object();
  for (const char* key : {"mesh", "materials", "regions", "elasticity", "mass", "damping", "gravity", "loads", "terms",
                          "clamps", "motions", "start", "initial"})
    if (resolved.has(key) && !resolved.at(key).is_null()) out[key] = json_of(resolved.at(key));
  return out;
}

// Replaces invalid UTF-8, which file names may contain.
std::string text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json begin_json(const std::string& scene, const std::vector<std::string>& set, const std::vector<Restart>& restarts,
                const Json& model_keys) {
  Json out{{"status", "running"},
           {"scene", scene},
           {"set", set},
           {"versions", versions_json()},
           {"machine", machine_json()},
           {"threads", loop_threads()},
           {"model", {{"given", model_keys}}}};
  for (const auto& r : restarts)
    out["restarts"].push_back({{"time", r.time}, {"at", r.at}, {"after", r.after}, {"changed", r.changed}});
  return out;
}

Json model_json(const ModelSummary& model, const Json& model_keys) {
  Json terms = Json::array();
  for (const auto& term : model.terms) terms.push_back(term);
  Json out{{"nodes", model.nodes},
           {"elements", model.elements},
           {"unknowns", model.unknowns},
           {"terms", terms},
           {"given", model_keys}};
  if (!model.kinematics.empty()) out["kinematics"] = model.kinematics;
  if (model.linear_error && std::isfinite(*model.linear_error)) out["linear_error"] = *model.linear_error;
  return out;
}

Json energy_json(const EnergySummary& energy) {
  const auto& e = energy.last;
  return {{"time", energy.time},
          {"kinetic", e.kinetic},
          {"elastic", e.elastic},
          {"gravitational", e.gravitational},
          {"dissipated", e.dissipated},
          {"loads", e.loads},
          {"balance_drift", energy.drift},
          {"scale", energy.scale},
          {"times", energy.times == EnergyTimes::steps ? "steps" : "outputs"}};
}

Json norms_json(const ErrorNorms& e) { return {{"final", e.final}, {"rms", e.l2}, {"largest", e.max}}; }

Json error_json(const ErrorEstimate& e) {
  Json out{{"against", e.against}, {"wall_seconds", e.wall_seconds}};
  if (!e.completed) {
    out["trouble"] = e.failure_reason;
    return out;
  }
  out["samples"] = e.samples;
  out["displacement"] = norms_json(e.displacement);
  out["velocity"] = norms_json(e.velocity);
  return out;
}

Json errors_json(const ErrorBalance& errors) {
  Json out{{"mesh", errors.mesh}, {"mesh_by", errors.mesh_by}};
  if (errors.time) out["time"] = *errors.time;
  for (const ProbedError& e : errors.probed)
    out["probes"][e.probe][e.field] = {{"error", e.error}, {"scale", e.scale}, {"unit", e.unit}};
  if (errors.probed_unknown) out["probes"] = nullptr;
  if (!errors.advice.empty()) out["advice"] = errors.advice;
  return out;
}

Json failure_json(const Outcome& outcome) {
  return {{"reason", reason_name(outcome.reason)}, {"message", outcome.message}};
}

Json place_json(const FailurePlace& place, double time) {
  return {{"time", time},
          {"element_with_smallest_det_f", place.element},
          {"smallest_det_f", place.smallest_det_f},
          {"fastest_node", place.node},
          {"largest_speed", place.largest_speed}};
}

void add_motion(Json& out, const MotionResult& motion, const Outcome& outcome) {
  Json decisions;
  for (const auto& [key, value] : motion.decisions) decisions[key] = value;
  out["integrator"] = decisions;
  out["time_reached"] = outcome.last.t;
  out["wall_seconds"] = motion.cost.wall_seconds;
  out["cpu_seconds"] = motion.cost.cpu_seconds;
  out["statistics"] = to_json(motion.cost.statistics);
  out["factor_bytes"] = motion.factor_bytes;
  out["smallest_det_f"] = {
      {"value", motion.det_f.value}, {"element", motion.det_f.element}, {"time", motion.det_f.time}};
  if (motion.energy) out["energy"] = energy_json(*motion.energy);
  if (motion.momentum)
    out["momentum"] = {{"angular_drift", motion.momentum->angular_drift},
                       {"angular_scale", motion.momentum->angular_scale}};
  if (const auto& j = motion.joints) out["joints"] = {{"largest_gap", j->gap}, {"largest_rate", j->rate}};
  if (const auto& c = motion.contacts) out["contacts"] = {{"count", c->count}, {"untouched", c->untouched}};
  if (const auto& e = motion.segment_error)
    out["accumulated_error"] = {{"error", e->error}, {"parts", e->segments},  {"steps_each", e->steps},
                                {"since", e->since}, {"against", e->against}, {"wall_seconds", e->wall_seconds}};
  if (motion.error) out["estimated_error"] = error_json(*motion.error);
  if (motion.rtol) out["rtol"] = *motion.rtol;
  if (!outcome.remark.empty()) out["remark"] = outcome.remark;
  if (outcome.status != Outcome::Status::failed) return;
  out["failure"] = failure_json(outcome);
  if (motion.failure) out["failure"]["where"] = place_json(*motion.failure, outcome.last.t);
}

Json to_json(const std::optional<int>& count) { return count ? Json(*count) : Json(nullptr); }

Json to_json(const RecordedExtreme& extreme) {
  if (extreme.node < 0) return nullptr;
  Json out = {{"value", extreme.value},
              {"unit", extreme.unit},
              {"time", extreme.time},
              {"node", extreme.node},
              {"place", {extreme.place[0], extreme.place[1], extreme.place[2]}},
              {"region", extreme.region.empty() ? Json(nullptr) : Json(extreme.region)},
              {"states", extreme.states}};
  for (const auto& [path, derivative] : extreme.derivatives) out["derivatives"][path] = derivative;
  if (!extreme.remark.empty()) out["remark"] = extreme.remark;
  return out;
}

Json to_json(const CriticalPoint& point) {
  return {{"kind", words_of(point.kind)},
          {"load_factor", point.load_factor},
          {"uncertainty", point.uncertainty},
          {"unstable_directions_after", to_json(point.unstable)}};
}

void add_equilibrium(Json& out, const EquilibriumResult& equilibrium, const Outcome& outcome) {
  out["load_factor_reached"] = outcome.last.t;
  out["loads_at_time"] = equilibrium.loads_at_time;
  out["load_steps"] = equilibrium.load_steps;
  out["rejected_load_steps"] = equilibrium.rejected_load_steps;
  out["jumps"] = equilibrium.jumps;
  out["critical_points"] = Json::array();
  for (const CriticalPoint& point : equilibrium.critical_points) out["critical_points"].push_back(to_json(point));
  out["unstable_directions"] = to_json(equilibrium.unstable);
  out["unsymmetric_stiffness"] = equilibrium.unsymmetric;
  out["largest_displacement"] = equilibrium.largest_displacement;
  out["residual"] = equilibrium.residual;
  out["solver"] = equilibrium.solver;
  for (const auto& [probe, value, error] : equilibrium.probes)
    out["probes"][probe] = {{"displacement", {value[0], value[1], value[2]}},
                            {"mesh_error", {error[0], error[1], error[2]}}};
  out["statistics"] = to_json(equilibrium.statistics);
  out["wall_seconds"] = outcome.wall_seconds;
  out["cpu_seconds"] = outcome.cpu_seconds;
  if (outcome.status == Outcome::Status::failed) out["failure"] = failure_json(outcome);
}

void add_buckling(Json& out, const BucklingResult& buckling, const Outcome& outcome) {
  out["loads_at_time"] = buckling.loads_at_time;
  out["modes"] = Json::array();
  for (const auto& mode : buckling.modes)
    out["modes"].push_back(
        {{"load_factor", mode.load_factor}, {"mesh_error", mode.mesh_error}, {"residual", mode.residual}});
  out["wall_seconds"] = outcome.wall_seconds;
  out["cpu_seconds"] = outcome.cpu_seconds;
  if (outcome.status == Outcome::Status::failed) out["failure"] = failure_json(outcome);
}

void add_harmonic(Json& out, const HarmonicResult& harmonic, const Outcome& outcome) {
  out["about_equilibrium"] = harmonic.is_loaded;
  out["frequencies"] = {{"count", harmonic.frequencies}, {"lowest", harmonic.lowest}, {"highest", harmonic.highest}};
  out["modes"] = Json::array();
  for (const auto& mode : harmonic.modes)
    out["modes"].push_back(
        {{"frequency", mode.frequency}, {"damping_ratio", mode.damping_ratio}, {"mesh_error", mode.mesh_error}});
  for (const auto& peak : harmonic.peaks)
    out["peaks"][peak.quantity] = {{"frequency", peak.frequency}, {"amplitude", peak.amplitude}, {"unit", peak.unit}};
  out["basis"] = harmonic.basis;
  out["error"] = harmonic.error;
  out["wall_seconds"] = outcome.wall_seconds;
  out["cpu_seconds"] = outcome.cpu_seconds;
  if (outcome.status == Outcome::Status::failed) out["failure"] = failure_json(outcome);
}

}  // namespace

RunRecord::RunRecord(const std::filesystem::path& folder, const std::string& scene, const std::vector<std::string>& set,
                     const std::vector<Restart>& restarts, const Config& resolved)
    : begin_(begin_json(scene, set, restarts, model_sections(resolved))),
      file_(folder / kRunRecordFile, text(begin_)) {}

void RunRecord::finish(const RunResult& result) const {
  Json out = begin_;
  out["status"] = status_word(result.outcome.status);
  out["ranks"] = result.ranks;
  if (result.equilibrium) out["analysis"] = "static";
  if (result.buckling) out["analysis"] = "buckling";
  if (result.harmonic) out["analysis"] = "harmonic";
  out["model"] = model_json(result.model, begin_.at("model").at("given"));
  if (result.motion) add_motion(out, *result.motion, result.outcome);
  if (result.equilibrium) add_equilibrium(out, *result.equilibrium, result.outcome);
  if (result.buckling) add_buckling(out, *result.buckling, result.outcome);
  if (result.harmonic) add_harmonic(out, *result.harmonic, result.outcome);
  for (const RecordedExtreme& extreme : result.extremes) out["extremes"][extreme.quantity] = to_json(extreme);
  if (const auto errors = error_balance(result)) out["errors"] = errors_json(*errors);
  if (const auto warnings = result_warnings(result); !warnings.empty()) out["warnings"] = warnings;
  file_.rewrite(text(out));
}

}  // namespace orthodyn
