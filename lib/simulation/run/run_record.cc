#include "lib/simulation/run/run_record.h"

#include <cmath>

#include "lib/core/parallel.h"
#include "lib/simulation/error_estimate/error_balance.h"
#include "lib/simulation/run/machine.h"
#include "lib/simulation/run/result_warnings.h"

namespace orthodyn {

namespace {

// A path need not be UTF-8.
std::string text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json begin_json(const std::string& scene, const std::vector<std::string>& set, const std::vector<Restart>& restarts,
                const Json& given) {
  Json out{{"status", "running"},
           {"scene", scene},
           {"set", set},
           {"versions", versions_json()},
           {"machine", machine_json()},
           {"threads", loop_threads()},
           {"model", {{"given", given}}}};
  for (const auto& r : restarts)
    out["restarts"].push_back({{"time", r.time}, {"at", r.at}, {"after", r.after}, {"changed", r.changed}});
  return out;
}

Json model_json(const ModelSummary& model, const Json& given) {
  Json terms = Json::array();
  for (const auto& term : model.terms) terms.push_back(term);
  Json out{{"nodes", model.nodes},
           {"elements", model.elements},
           {"unknowns", model.unknowns},
           {"terms", terms},
           {"given", given}};
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
  out["wall_seconds"] = motion.effort.wall_seconds;
  out["cpu_seconds"] = motion.effort.cpu_seconds;
  out["statistics"] = to_json(motion.effort.statistics);
  out["factor_bytes"] = motion.factor_bytes;
  out["smallest_det_f"] = {
      {"value", motion.det_f.value}, {"element", motion.det_f.element}, {"time", motion.det_f.time}};
  if (motion.energy) out["energy"] = energy_json(*motion.energy);
  if (motion.momentum)
    out["momentum"] = {{"angular_drift", motion.momentum->angular_drift},
                       {"angular_scale", motion.momentum->angular_scale}};
  if (const auto& e = motion.accumulated)
    out["accumulated_error"] = {{"error", e->error}, {"parts", e->parts},     {"steps_each", e->steps},
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
  return {{"value", extreme.value},
          {"unit", extreme.unit},
          {"time", extreme.time},
          {"node", extreme.node},
          {"place", {extreme.place[0], extreme.place[1], extreme.place[2]}},
          {"states", extreme.states}};
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

}  // namespace

RunRecord::RunRecord(const std::filesystem::path& folder, const std::string& scene, const std::vector<std::string>& set,
                     const std::vector<Restart>& restarts, const Json& given)
    : begin_(begin_json(scene, set, restarts, given)), file_(folder / kRunRecordFile, text(begin_)) {}

void RunRecord::finish(const RunResult& result) const {
  Json out = begin_;
  out["status"] = status_word(result.outcome.status);
  out["ranks"] = result.ranks;
  if (result.equilibrium) out["analysis"] = "static";
  if (result.buckling) out["analysis"] = "buckling";
  out["model"] = model_json(result.model, begin_.at("model").at("given"));
  if (result.motion) add_motion(out, *result.motion, result.outcome);
  if (result.equilibrium) add_equilibrium(out, *result.equilibrium, result.outcome);
  if (result.buckling) add_buckling(out, *result.buckling, result.outcome);
  for (const RecordedExtreme& extreme : result.extremes) out["extremes"][extreme.quantity] = to_json(extreme);
  if (const auto errors = error_balance(result)) out["errors"] = errors_json(*errors);
  if (const auto warnings = result_warnings(result); !warnings.empty()) out["warnings"] = warnings;
  file_.rewrite(text(out));
}

}  // namespace orthodyn
