#include "lib/simulation/simulation.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "lib/core/versions.h"
#include "lib/simulation/checkpoint/resume.h"
#include "lib/simulation/output/output_size.h"
#include "lib/simulation/run/run_threads.h"

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
  return from_config(Config::from_file(file), file, changes);
}

Simulation Simulation::from_text(const std::string& text, const std::string& name, const SceneChanges& changes) {
  return from_config(Config::from_text(text, name), name, changes);
}

Simulation Simulation::from_config(Config scene, const std::string& file, const SceneChanges& changes) {
  std::vector<std::string> left_out;
  scene = changed_scene(std::move(scene), changes, &left_out);
  return {file, changes, std::move(scene), left_out_sentence(left_out, changes)};
}

RunResult Simulation::run(const RunRequest& request) const {
  const std::atomic<bool> never{false};
  return run(request, never);
}

RunResult Simulation::run(const RunRequest& request, const std::atomic<bool>& interrupt) const {
  RunListener nobody;
  return run(request, interrupt, nobody);
}

RunResult Simulation::run(const RunRequest& request, const std::atomic<bool>& interrupt, RunListener& listener) const {
  if (!notice_.empty()) listener.on_notice(notice_);
  RunRequest how = request;
  std::optional<RunResult> result;
  start_again_if_outgrown(scene_, [&](Config config, const std::string& given_up) {
    if (!given_up.empty()) how.force = true, how.resume = false;
    result = run_once(std::move(config), how, given_up, interrupt, listener);
    if (result->outgrown && !interrupt)
      listener.on_notice(result->outgrown->why + ": starts again with corotational kinematics");
    return interrupt ? std::nullopt : result->outgrown;
  });
  return std::move(*result);
}

namespace {

RunAnalysis analysis_of(const Scene& scene) {
  switch (scene.analysis) {
    case Analysis::statical: return run_static_analysis;
    case Analysis::buckling: return run_buckling_analysis;
    case Analysis::dynamic: break;
  }
  return run_dynamic_analysis;
}

}  // namespace

// `given_up`: where linear kinematics were before, and why; else "".
RunResult Simulation::run_once(Config config, const RunRequest& request, const std::string& given_up,
                               const std::atomic<bool>& interrupt, RunListener& listener) const {
  const Ranks* ranks = request.ranks;
  const RunThreads threads(config, ranks != nullptr);
  const auto warn = [&](const std::string& text) { listener.on_warning(text); };
  ResultFolder folder(request.folder, earlier_result(request), warn);
  std::optional<Checkpoint> earlier;
  if (folder.resumes()) earlier = Checkpoint::load(folder.checkpoint());
  if (ranks) ranks->any(false);  // all have looked at the folder before the first rank changes it
  if (earlier) keep_choices(*earlier, config);
  Setup setup = set_up(std::move(config), earlier && was_linear_so_far(*earlier), true, ranks);
  if (!given_up.empty()) setup.note_given_up(given_up);
  for (const auto& warning : setup.built.warnings) listener.on_warning(warning);
  if (ranks)
    listener.on_notice(
        fmt::format("on {} ranks, which do not look for values that are probably not intended, nor for "
                    "strains beyond the material's limits (orthodyn check does){}",
                    ranks->size(), setup.scene.is_static() ? "" : ", and do not tell how far errors add up"));
  if (!request.any_output_size) require_usual_output_size(setup);
  const std::string resolved = resolved_scene(setup, file_, folder.path());
  return analysis_of(setup.scene)(
      {file_, changes_.set, request, setup, resolved, folder, std::move(earlier), interrupt, listener});
}

}  // namespace orthodyn
