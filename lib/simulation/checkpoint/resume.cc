#include "lib/simulation/checkpoint/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lib/ode/internal_variables.h"
#include "lib/simulation/checkpoint/scene_changes.h"
#include "lib/simulation/run/fingerprints.h"
#include "lib/simulation/run/machine.h"

namespace orthodyn {

namespace {

OutputSchedule schedule_of(const Scene& scene) {
  const double span = scene.time.end - scene.time.start;
  const int frames = scene.output.frames.value_or(50);
  return {scene.time.start, scene.time.end,
          scene.output.interval ? *scene.output.interval
          : frames > 0          ? span / frames
                                : 0};
}

// Keys are paths relative to the result folder, as in the stored scene, so that naming a run by its scene or by its
// folder gives the same keys.
std::map<std::string, std::string> file_fingerprints(const Config& scene, const ResultFolder& folder) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> out;
  for (const auto& file : scene.file_paths()) {
    const fs::path whole = fs::absolute(file).lexically_normal();
    out[whole.lexically_proximate(fs::absolute(folder.path()).lexically_normal()).string()] =
        Fingerprint().add_file(file).text();
  }
  return out;
}

void require_same_files(const Checkpoint& checkpoint, const Setup& setup, const ResultFolder& folder) {
  for (const auto& [file, print] : file_fingerprints(setup.config, folder)) {
    const auto before = checkpoint.files.find(file);
    if (before != checkpoint.files.end() && before->second == print) continue;
    throw ConfigError(
        (folder.path() / file).lexically_normal().string(),
        fmt::format("has changed since {} was computed; put it back, or start anew with --force instead of --resume",
                    folder.checkpoint().string()));
  }
}

void require_same_model(const Checkpoint& checkpoint, const Setup& setup, const ResultFolder& folder) {
  const FemModel& model = *setup.built.model;
  const Eigen::Index unknowns = model.num_dofs_of_all();
  if (checkpoint.mesh == mesh_fingerprint(model.parts().mesh) && checkpoint.state.q.size() == unknowns &&
      checkpoint.state.v.size() == unknowns &&
      checkpoint.state.z.size() == (model.internal_variables() ? model.internal_variables()->size() : 0))
    return;
  throw ConfigError(
      folder.checkpoint().string(),
      "the mesh has changed since the checkpoint; put it back, or start anew with --force instead of --resume");
}

void require_time_left(const Checkpoint& checkpoint, const Setup& setup) {
  if (setup.scene.time.end >= checkpoint.state.t) return;
  setup.config.at("time").at("end").fail(fmt::format(
      "{} s lies before the checkpoint at t = {:.6g} s; give a later end", setup.scene.time.end, checkpoint.state.t));
}

// The value of `kinematics` in the section `elasticity` or in an entry of `regions`; "" if absent.
std::string kinematics_of(const Config& sections, const std::string& name) {
  const bool has_key = sections.has(name) && sections.at(name).is_map() && sections.at(name).has("kinematics");
  const Config section = has_key ? sections.at(name).at("kinematics") : sections;
  return has_key && !section.is_null() ? section.text() : "";
}

std::vector<std::string> regions_of(const Config& scene) {
  return scene.has("regions") && scene.at("regions").is_map() ? scene.at("regions").keys() : std::vector<std::string>{};
}

// Keeps regions corotational that became so in the earlier run.
void keep_kinematics(const Config& before, Config& scene) {
  const std::string corotational = "corotational", open = "auto";
  const bool is_open = kinematics_of(scene, "elasticity") == open;
  if (is_open && kinematics_of(before, "elasticity") == corotational) return make_corotational(scene);
  for (const auto& name : regions_of(scene)) {
    const std::string now = kinematics_of(scene.at("regions"), name);
    if (now != open && !(now.empty() && is_open)) continue;
    if (!before.has("regions") || kinematics_of(before.at("regions"), name) != corotational) continue;
    Config region = scene.at("regions").at(name);
    region.set("kinematics", corotational);
  }
}

}  // namespace

bool was_linear(const Checkpoint& checkpoint) {
  const Config before = Config::from_text(checkpoint.scene, "checkpoint.cbor");
  if (kinematics_of(before, "elasticity") == "auto") return true;
  const auto regions = regions_of(before);
  return std::any_of(regions.begin(), regions.end(),
                     [&](const std::string& name) { return kinematics_of(before.at("regions"), name) == "auto"; });
}

void keep_choices(const Checkpoint& checkpoint, Config& scene) {
  if (!scene.is_map()) return;  // read_scene() reports the error
  const Config before = Config::from_text(checkpoint.scene, "checkpoint.cbor");
  keep_kinematics(before, scene);
  if (!before.has("integrator")) return;
  const Config earlier = before.at("integrator");
  if (scene.has("integrator") && !scene.at("integrator").is_map()) return;  // read_scene() reports the error
  if (!scene.has("integrator") || !scene.at("integrator").has("type")) scene.set("integrator.type", earlier.at("type"));
  const Config section = scene.at("integrator");
  std::vector<std::string> choices{"position_scale", "velocity_scale"};
  if (section.at("type").yaml() == "auto") choices.insert(choices.end(), {"method", "because", "safety", "modes"});
  if (earlier.has("type") && section.at("type").yaml() == earlier.at("type").yaml()) choices.push_back("max_order");
  for (const auto& key : choices)
    if (!section.has(key) && earlier.has(key)) scene.set("integrator." + key, earlier.at(key));
}

Checkpoint first_checkpoint(const Setup& setup, const std::string& resolved, const ResultFolder& folder) {
  Checkpoint checkpoint;
  checkpoint.scene = resolved;
  checkpoint.mesh = mesh_fingerprint(setup.built.model->parts().mesh);
  checkpoint.files = file_fingerprints(setup.config, folder);
  checkpoint.state = setup.built.model->whole(setup.built.initial);
  checkpoint.last_output = checkpoint.last_history = setup.built.initial.t;
  checkpoint.schedule = schedule_of(setup.scene);
  return checkpoint;
}

Checkpoint resumed_checkpoint(Checkpoint checkpoint, const Setup& setup, const std::string& resolved,
                              const ResultFolder& folder) {
  const auto changed =
      changed_keys(with_defaults(Config::from_text(checkpoint.scene, "checkpoint.cbor")), Config::from_text(resolved));
  if (const auto refused = refused_changes(changed); !refused.empty())
    throw ConfigError(folder.checkpoint().string(),
                      fmt::format("belongs to another simulation: {} differ{}. A resumed run may change time.end, "
                                  "checkpoint, expect, output.accumulated_error and the integrator's limits max_steps, "
                                  "h_min, max_newton_iterations; for other changes choose another folder with --out",
                                  join(refused), refused.size() == 1 ? "s" : ""));
  require_same_files(checkpoint, setup, folder);
  require_same_model(checkpoint, setup, folder);
  require_time_left(checkpoint, setup);
  checkpoint.scene = resolved;
  checkpoint.restarts.push_back({checkpoint.state.t, utc_now(), folder.earlier_status(), changed});
  return checkpoint;
}

bool is_complete(const Checkpoint& checkpoint, const Scene& scene) {
  return checkpoint.begun && checkpoint.state.t >= scene.time.end;
}

Plan plan_of(const Scene& scene, const OutputSchedule& schedule) {
  const double start = scene.time.start, end = scene.time.end;
  Plan plan{.end = end, .exact_times = scene.output.times == OutputTimes::exact};
  if (scene.output.interval) plan.output_times = by_interval(start, end, *scene.output.interval);
  else if (end == schedule.end) plan.output_times = evenly_spaced(start, end, scene.output.frames.value_or(50));
  else if (schedule.interval > 0) plan.output_times = by_interval(start, end, schedule.interval);
  if (const auto& history = scene.output.history) {
    plan.history_at_steps = history->steps;
    if (history->interval) plan.history_times = by_interval(start, end, *history->interval);
  }
  return plan;
}

}  // namespace orthodyn
