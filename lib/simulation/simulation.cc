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

// Where linear kinematics are outgrown, a second time from the start.
RunResult Simulation::run(const RunRequest& request, const std::atomic<bool>& interrupt, RunListener& listener) const {
  std::string outgrown;
  RunResult result = run_once(scene_.copy(), request, outgrown, interrupt, listener);
  if (!result.outgrown || interrupt) return result;
  listener.on_notice(outgrown + ": starts again with corotational kinematics");
  Config corotational = scene_.copy();
  set_kinematics(corotational, "corotational");
  RunRequest again = request;
  again.force = true;
  again.resume = false;
  return run_once(std::move(corotational), again, outgrown, interrupt, listener);
}

// `outgrown` says why linear kinematics were given up: in the first run it is set where that happens, in the second it
// is told.
RunResult Simulation::run_once(Config config, const RunRequest& request, std::string& outgrown,
                               const std::atomic<bool>& interrupt, RunListener& listener) const {
  const auto warn = [&](const std::string& text) { listener.on_warning(text); };
  ResultFolder folder(request.folder, earlier_result(request), warn);
  std::optional<Checkpoint> earlier;
  if (folder.resumes()) earlier = Checkpoint::load(folder.checkpoint());
  if (earlier) keep_choices(*earlier, config);
  Setup setup = set_up(std::move(config), earlier && was_linear_so_far(*earlier));
  if (!outgrown.empty()) setup.kinematics = KinematicsChoice{false, "corotational: " + outgrown};
  for (const auto& warning : setup.built.warnings) listener.on_warning(warning);
  const std::string resolved = resolved_scene(setup, file_, folder.path());
  const RunAnalysis analysis = setup.scene.analysis == Analysis::statical ? run_static_analysis : run_dynamic_analysis;
  RunResult result =
      analysis({file_, changes_.set, request, setup, resolved, folder, std::move(earlier), interrupt, listener});
  if (result.outgrown) outgrown = outgrown_sentence(*setup.linearity);
  return result;
}

}  // namespace orthodyn
