#include "lib/simulation/simulation.h"

#include <fmt/format.h>

#include "lib/core/versions.h"
#include "lib/simulation/checkpoint/resume.h"

namespace orthodyn {

namespace {

Earlier earlier_result(const RunRequest& request) {
  if (request.resume) return Earlier::resume;
  return request.force ? Earlier::replace : Earlier::keep;
}

// So placed that it can be run from the result's folder.
std::string resolved_scene(const Setup& setup, const std::string& file, const std::filesystem::path& folder) {
  return fmt::format("# {} with every default spelled out, by orthodyn {}.\n{}", file, orthodyn_version(),
                     setup.config.dump_for(folder.string()));
}

}  // namespace

Simulation Simulation::from_file(const std::string& file, const SceneChanges& changes) {
  return {file, changes, read_scene_file(file, changes)};
}

RunResult Simulation::run(const RunRequest& request) const {
  const std::atomic<bool> never{false};
  return run(request, never);
}

RunResult Simulation::run(const RunRequest& request, const std::atomic<bool>& interrupt) const {
  RunListener nobody;
  return run(request, interrupt, nobody);
}

// Where linear kinematics are outgrown, again from the start.
RunResult Simulation::run(const RunRequest& request, const std::atomic<bool>& interrupt, RunListener& listener) const {
  Config scene = scene_.copy();
  RunRequest again = request;
  std::string given_up;
  for (;;) {
    RunResult result = run_once(scene, again, given_up, interrupt, listener);
    if (!result.outgrown || interrupt) return result;
    again.force = true;
    again.resume = false;
  }
}

// Where linear kinematics are outgrown, `scene` gives them up, and `given_up` says why, for the next run to tell.
RunResult Simulation::run_once(Config& scene, const RunRequest& request, std::string& given_up,
                               const std::atomic<bool>& interrupt, RunListener& listener) const {
  const auto warn = [&](const std::string& text) { listener.on_warning(text); };
  ResultFolder folder(request.folder, earlier_result(request), warn);
  std::optional<Checkpoint> earlier;
  if (folder.resumes()) earlier = Checkpoint::load(folder.checkpoint());
  if (earlier) keep_choices(*earlier, scene);
  Setup setup = set_up(scene, earlier && was_linear_so_far(*earlier));
  if (!given_up.empty()) {
    if (!setup.kinematics) setup.kinematics.emplace();
    setup.kinematics->add_reason(given_up);
  }
  for (const auto& warning : setup.built.warnings) listener.on_warning(warning);
  const std::string resolved = resolved_scene(setup, file_, folder.path());
  const RunAnalysis analysis = setup.scene.analysis == Analysis::statical ? run_static_analysis : run_dynamic_analysis;
  RunResult result =
      analysis({file_, changes_.set, request, setup, resolved, folder, std::move(earlier), interrupt, listener});
  if (result.outgrown && !interrupt) {
    given_up = give_up_outgrown(scene, *setup.linearity);
    listener.on_notice(outgrown_sentence(*setup.linearity) + ": starts again with corotational kinematics");
  }
  return result;
}

}  // namespace orthodyn
