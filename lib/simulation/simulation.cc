#include "lib/simulation/simulation.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "lib/core/parallel.h"
#include "lib/core/versions.h"
#include "lib/linear/blas.h"
#include "lib/scene/scene.h"
#include "lib/simulation/checkpoint/resume.h"
#include "lib/simulation/preflight/output_size.h"

namespace orthodyn {

namespace {

EarlierResult treatment_of_earlier_result(const RunRequest& request) {
  if (request.resume) return EarlierResult::resume;
  return request.force ? EarlierResult::replace : EarlierResult::keep;
}

std::optional<int> threads_named_by(const Config& scene) {
  if (!scene.is_map() || !scene.has("threads") || scene.at("threads").is_null()) return std::nullopt;
  return Value<int>::read(scene.at("threads"), {.range = kThreads});
}

// Sets the number of threads of a run, set-up included, for the lifetime of this object: the scene's `threads` if
// given, else all threads of the machine, or one thread on each of several ranks. BLAS is limited only if `threads` is
// given or on several ranks.
class RunThreads {
 public:
  RunThreads(const Config& scene, bool on_ranks) : RunThreads(threads_named_by(scene), on_ranks) {}

 private:
  RunThreads(std::optional<int> named, bool on_ranks)
      : loops_(named.value_or(on_ranks ? 1 : available_threads())), blas_(on_ranks ? named.value_or(1) : named) {}

  LoopThreads loops_;
  BlasThreadLimit blas_;
};

void refuse_dynamic_options(const RunRequest& request, const std::string& analysis) {
  if (request.resume)
    throw ConfigError(fmt::format("--resume: a {} analysis keeps no checkpoint; start anew with --force", analysis));
  if (request.estimate_error)
    throw ConfigError(fmt::format("--estimate-error: a {} analysis has no integration error; remove it", analysis));
}

// Relative paths are rewritten relative to the result folder, so that the scene can be run from there.
std::string resolved_scene(const Setup& setup, const std::string& file, const std::filesystem::path& folder) {
  return fmt::format("# {} with every default spelled out, by orthodyn {}.\n{}", file, orthodyn_version(),
                     setup.config.dump_for(folder.string()));
}

RunAnalysis analysis_of(const Scene& scene) {
  switch (scene.analysis) {
    case Analysis::statical: return run_static_analysis;
    case Analysis::buckling: return run_buckling_analysis;
    case Analysis::harmonic: return run_harmonic_analysis;
    case Analysis::dynamic: break;
  }
  return run_dynamic_analysis;
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
  run_with_kinematics_restarts(scene_, [&](Config config, const std::string& restart_reason) {
    if (!restart_reason.empty()) how.force = true, how.resume = false;
    result = run_once(std::move(config), how, restart_reason, interrupt, listener);
    if (result->kinematics_restart && !interrupt)
      listener.on_notice(result->kinematics_restart->why + ": starts again with corotational kinematics");
    return interrupt ? std::nullopt : result->kinematics_restart;
  });
  return std::move(*result);
}

// `restart_reason`: why earlier attempts with linear kinematics were abandoned; "" at first.
RunResult Simulation::run_once(Config config, const RunRequest& request, const std::string& restart_reason,
                               const std::atomic<bool>& interrupt, RunListener& listener) const {
  const Ranks* ranks = request.ranks;
  const RunThreads threads(config, ranks != nullptr);
  const auto warn = [&](const std::string& text) { listener.on_warning(text); };
  ResultFolder folder(request.folder, treatment_of_earlier_result(request), warn);
  std::optional<Checkpoint> earlier;
  if (folder.resumes()) earlier = Checkpoint::load(folder.checkpoint());
  if (ranks) ranks->any(false);  // all ranks have inspected the folder before the first rank changes it
  if (earlier) keep_choices(*earlier, config);
  Setup setup = set_up(std::move(config), earlier && was_linear(*earlier), true, ranks);
  if (!restart_reason.empty()) setup.note_kinematics_restart(restart_reason);
  for (const auto& warning : setup.built.warnings) listener.on_warning(warning);
  if (ranks)
    listener.on_notice(
        fmt::format("on {} ranks: unlikely input values and strains beyond the material's limits are not checked (use "
                    "orthodyn check){}",
                    ranks->size(), setup.scene.is_static() ? "" : ", and accumulated errors are not estimated"));
  if (!request.allow_large_output) require_allowed_output_size(setup);
  const std::string resolved = resolved_scene(setup, file_, folder.path());
  if (setup.scene.analysis != Analysis::dynamic)
    refuse_dynamic_options(request, Value<Analysis>::yaml(setup.scene.analysis));
  return analysis_of(setup.scene)(
      {file_, changes_.set, request, setup, resolved, folder, std::move(earlier), interrupt, listener});
}

}  // namespace orthodyn
