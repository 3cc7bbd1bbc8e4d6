#include "tools/orthodyn/resume.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/fingerprint.h"
#include "lib/study/machine.h"
#include "tools/orthodyn/scene_changes.h"

namespace orthodyn {

namespace {

OutputRhythm rhythm_of(const Scene& scene) {
  const double span = scene.time.end - scene.time.start;
  const int frames = scene.output.frames.value_or(50);
  return {scene.time.start, scene.time.end,
          scene.output.interval ? *scene.output.interval : frames > 0 ? span / frames : 0};
}

void require_same_model(const Checkpoint& checkpoint, const Setup& setup, const ResultFolder& folder) {
  const FemModel& model = *setup.built.model;
  if (checkpoint.geometry == geometry_fingerprint(model) && checkpoint.state.q.size() == model.num_dofs() &&
      checkpoint.state.v.size() == model.num_dofs())
    return;
  throw ConfigError(fmt::format("{}: the mesh is not the one that the checkpoint was computed with; put it back, or "
                                "start anew with --force in place of --resume",
                                folder.checkpoint().string()));
}

void require_time_left(const Checkpoint& checkpoint, const Setup& setup) {
  if (setup.scene.time.end >= checkpoint.state.t) return;
  setup.config.at("time").at("end").fail(fmt::format("{} s lies before the checkpoint at t = {:.6g} s; give a later end",
                                                     setup.scene.time.end, checkpoint.state.t));
}

}  // namespace

void keep_scales(const Checkpoint& checkpoint, Config& scene) {
  const Config before = Config::from_text(checkpoint.scene, "checkpoint.cbor");
  if (!before.has("integrator")) return;
  for (const std::string key : {"position_scale", "velocity_scale"}) {
    const bool open = !scene.has("integrator") || !scene.at("integrator").has(key);
    if (open && before.at("integrator").has(key))
      scene.override_with(fmt::format("integrator.{}={}", key, before.at("integrator").at(key).text()));
  }
}

std::string geometry_fingerprint(const Model& model) {
  const Geometry geometry = model.geometry();
  const auto bytes = [](const auto& list) {
    return std::string(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  };
  return Fingerprint().add(bytes(geometry.points)).add(bytes(geometry.cells)).text();
}

Checkpoint first_checkpoint(const Setup& setup, const std::string& resolved) {
  Checkpoint checkpoint;
  checkpoint.scene = resolved;
  checkpoint.geometry = geometry_fingerprint(*setup.built.model);
  checkpoint.state = setup.built.initial;
  checkpoint.last_output = setup.built.initial.t;
  checkpoint.rhythm = rhythm_of(setup.scene);
  return checkpoint;
}

Checkpoint continued(Checkpoint checkpoint, const Setup& setup, const std::string& resolved,
                     const ResultFolder& folder) {
  const auto changed =
      changed_keys(Config::from_text(checkpoint.scene, "checkpoint.cbor"), Config::from_text(resolved));
  if (const auto refused = refused_changes(changed); !refused.empty())
    throw ConfigError(fmt::format("{}: is that of another simulation: {} differ{}. A run that goes on may change "
                                  "time.end, checkpoint, expect and the integrator's limits max_steps, h_min, "
                                  "max_newton_iterations; for all else choose another folder with --out",
                                  folder.checkpoint().string(), join(refused), refused.size() == 1 ? "s" : ""));
  require_same_model(checkpoint, setup, folder);
  require_time_left(checkpoint, setup);
  checkpoint.scene = resolved;
  checkpoint.restarts.push_back({checkpoint.state.t, utc_now(), folder.earlier_status(), changed});
  return checkpoint;
}

bool is_complete(const Checkpoint& checkpoint, const Scene& scene) {
  return checkpoint.begun && checkpoint.state.t >= scene.time.end;
}

Plan plan_of(const Scene& scene, const OutputRhythm& rhythm) {
  const double start = scene.time.start, end = scene.time.end;
  Plan plan{end, {}, scene.output.times == OutputTimes::exact};
  if (scene.output.interval) plan.output_times = by_interval(start, end, *scene.output.interval);
  else if (end == rhythm.end) plan.output_times = evenly_spaced(start, end, scene.output.frames.value_or(50));
  else if (rhythm.interval > 0) plan.output_times = by_interval(start, end, rhythm.interval);
  return plan;
}

}  // namespace orthodyn
