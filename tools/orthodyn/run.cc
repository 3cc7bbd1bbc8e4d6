// `orthodyn run`: one scene from start to end, with everything that it writes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lib/config/values.h"
#include "lib/core/versions.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/report.h"
#include "lib/simulation/result_folder.h"
#include "lib/simulation/resume.h"
#include "lib/simulation/run_observers.h"
#include "lib/simulation/scene_changes.h"
#include "tools/orthodyn/static_run.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// The scene with every default, so placed that it can be run from the result's folder.
std::string resolved_scene(const Setup& setup, const RunArguments& arguments, const fs::path& folder) {
  return fmt::format("# {} with every default spelled out, by orthodyn {}.\n{}", arguments.scene,
                     orthodyn_version(), setup.config.dump_for(folder.string()));
}

CheckpointTimes checkpoint_times(const Scene& scene) {
  if (!scene.checkpoint) return {.never = true};
  return {scene.checkpoint->every, scene.checkpoint->frames.value_or(0), false};
}

// `run DIR --resume` is the scene in that folder.
RunArguments spelled_out(RunArguments arguments) {
  if (!arguments.resume || !fs::is_directory(arguments.scene)) return arguments;
  if (!arguments.out) arguments.out = arguments.scene;
  arguments.scene = (fs::path(arguments.scene) / "scene.yaml").string();
  return arguments;
}

fs::path folder_for(const RunArguments& arguments) {
  return arguments.out ? fs::path(*arguments.out) : fs::path("out") / fs::path(arguments.scene).stem();
}

// A run that ended early can be taken up again whether or not the scene asks for checkpoints; one that
// completed can be extended if it does. A checkpoint that is there is kept up to date.
bool keeps_last_state(const Scene& scene, const Outcome& outcome, bool resumed) {
  if (!outcome.between_steps) return false;
  return scene.checkpoint || resumed || outcome.status != Outcome::Status::completed;
}

// False if it cannot be written, which a run that has its own trouble only mentions.
bool keep_last_state(Checkpointer& checkpointer, const Outcome& outcome) {
  try {
    checkpointer.write(outcome.last);
    return true;
  } catch (const RunError& e) {
    fmt::print(stderr, "warning: no checkpoint of the last state: {}\n", e.what());
    return false;
  }
}

class Run {
 public:
  explicit Run(const RunArguments& arguments)
      : arguments_(spelled_out(arguments)),
        folder_(folder_for(arguments_), arguments_.resume  ? Earlier::resume
                                        : arguments_.force ? Earlier::replace
                                                           : Earlier::keep) {}

  int execute() {
    if (folder_.resumes()) earlier_ = Checkpoint::load(folder_.checkpoint());
    Config config = read_config(arguments_.scene, arguments_.integrator, arguments_.set);
    if (earlier_) keep_scales(*earlier_, config);
    const Setup setup = set_up_and_warn(std::move(config));
    const std::string resolved = resolved_scene(setup, arguments_, folder_.path());
    if (setup.scene.analysis == Analysis::statical) return run_static(arguments_, setup, folder_, resolved);
    if (folder_.is_completed_without_checkpoint()) return decline_completed(resolved);
    const bool resumes = earlier_ && earlier_->begun;
    Checkpoint begin = resumes ? continued(std::move(*earlier_), setup, resolved, folder_)
                               : first_checkpoint(setup, resolved, folder_);
    // One that was killed after its last step still lacks its record.
    if (resumes && is_complete(begin, setup.scene) && begin.restarts.back().after == "completed")
      return say_complete(begin.state.t);
    if (arguments_.estimate_error) require_whole_run(setup);
    if (arguments_.estimate_error) estimator_.emplace(setup, plan_of(setup.scene, begin.rhythm));
    return resumes ? go_on(setup, std::move(begin)) : start(setup, std::move(begin));
  }

 private:
  static void require_whole_run(const Setup& setup) {
    for (const auto& event : setup.events)
      if (event.stops)
        throw ConfigError(fmt::format("--estimate-error compares two runs over the whole time, and the event '{}' stops "
                                      "them: remove one of the two",
                                      event.name));
  }

  int start(const Setup& setup, Checkpoint begin) {
    if (arguments_.resume && !arguments_.quiet)
      fmt::print(stderr, "nothing to resume in {}: starts from the beginning\n", folder_.path().string());
    folder_.prepare();
    const ReservedFile record(folder_.path() / "run.json", run_json(arguments_, {}, nullptr));
    write_file(folder_.path() / "scene.yaml", {begin.scene});
    if (setup.scene.checkpoint) begin.save(folder_.checkpoint());  // killed from here on, it can be resumed
    RunObservers observers(setup, folder_.path(), arguments_.quiet);
    return integrate(setup, std::move(begin), observers, record);
  }

  int go_on(const Setup& setup, Checkpoint begin) {
    RunObservers observers(setup, folder_.path(), arguments_.quiet);
    observers.restore(begin);
    if (!arguments_.quiet)
      fmt::print(stderr, "resumes at t = {:.6g} s; the integrator starts anew there: a multistep method at order 1\n",
                 begin.state.t);
    const ReservedFile record(folder_.path() / "run.json", run_json(arguments_, begin.restarts, nullptr));
    write_file(folder_.path() / "scene.yaml", {begin.scene});
    return integrate(setup, std::move(begin), observers, record);
  }

  int integrate(const Setup& setup, Checkpoint begin, RunObservers& observers, const ReservedFile& record) {
    Checkpointer checkpointer(folder_.checkpoint(), begin, checkpoint_times(setup.scene), observers.kept(),
                              *setup.integrator);
    Plan plan = plan_of(setup.scene, begin.rhythm);
    plan.events = observers.events();
    if (begin.begun) plan.delivered = begin.last_output;
    auto all = observers.all(checkpointer);
    if (estimator_) all.push_back(&estimator_->recorder());
    heed_interrupts();
    const Outcome outcome = run(*setup.built.model, *setup.integrator, begin.state, plan, all, interrupted());
    const bool kept = keeps_last_state(setup.scene, outcome, begin.begun) && keep_last_state(checkpointer, outcome);
    const Effort effort =
        begin.effort + Effort{setup.integrator->statistics(), outcome.wall_seconds, outcome.cpu_seconds};
    RunReport report{arguments_, setup, outcome, effort, observers.inversion,
                           observers.energy ? &*observers.energy : nullptr,
                           observers.momentum ? &*observers.momentum : nullptr};
    if (outcome.status == Outcome::Status::failed) fmt::print(stderr, "error: {}\n", outcome.message);
    record.rewrite(run_json(arguments_, begin.restarts, &report));
    if (!arguments_.quiet) print_summary(report, folder_.path());
    tell_what_remains(report, kept || setup.scene.checkpoint);
    if (!estimator_ || outcome.status != Outcome::Status::completed) return exit_code(outcome.status);
    report.error = repeat(setup.scene);
    record.rewrite(run_json(arguments_, begin.restarts, &report));
    print_error(*report.error);
    return report.error->completed ? 0 : interrupted() ? 130 : 3;
  }

  // The run once more, for the estimate of its error.
  ErrorEstimate repeat(const Scene& scene) const {
    std::optional<Progress> progress;
    if (!arguments_.quiet) {
      fmt::print(stderr, "repeats with {} to estimate the error\n", join(estimator_->refinement()));
      progress.emplace(scene.time.start, scene.time.end, stderr);
    }
    return estimator_->estimate(progress ? std::vector<Observer*>{&*progress} : std::vector<Observer*>{}, interrupted());
  }

  void tell_what_remains(const RunReport& report, bool resumable) const {
    const auto& inversion = report.inversion;
    if (inversion.smallest() <= 0)
      fmt::print(stderr, "warning: element {} was inverted at t = {:.4g} s (det F = {:.3g})\n", inversion.element(),
                 inversion.time(), inversion.smallest());
    if (report.outcome.status == Outcome::Status::interrupted)
      fmt::print(stderr, "interrupted at t = {:.6g} s; what was computed is in {}\n", report.outcome.last.t,
                 folder_.path().string());
    if (report.outcome.status != Outcome::Status::completed && resumable)
      fmt::print(stderr, "to go on: orthodyn run {} --resume\n", folder_.path().string());
  }

  int say_complete(double end) const {
    if (!arguments_.quiet)
      fmt::print("{} is complete at t = {:.6g} s: nothing to do\n", folder_.path().string(), end);
    return 0;
  }

  int decline_completed(const std::string& resolved) const {
    const auto earlier = Config::from_file((folder_.path() / "scene.yaml").string());
    const auto changed = changed_keys(earlier, Config::from_text(resolved));
    const bool longer = std::find(changed.begin(), changed.end(), "time.end") != changed.end();
    if (!longer && refused_changes(changed).empty())
      return say_complete(read_number(earlier.at("time").at("end"), {.unit = "s"}));
    throw ConfigError(fmt::format("{}: holds a completed run without a checkpoint, which cannot be resumed with other "
                                  "values ({}); start anew with --force in place of --resume",
                                  folder_.path().string(), join(changed)));
  }

  RunArguments arguments_;
  ResultFolder folder_;
  std::optional<Checkpoint> earlier_;
  std::optional<ErrorEstimator> estimator_;
};

void declare(RunArguments& arguments, CommandOptions& options) {
  declare_scene(arguments, options);
  options.value("--out", arguments.out, "Folder for the results; default out/<scene>.").type("DIR");
  options.flag("--quiet", arguments.quiet, "No progress and no summary.");
  options.flag("--force", arguments.force, "Replace an earlier result in the folder.");
  options
      .flag("--resume", arguments.resume,
            "Go on from the checkpoint in the folder, or begin if there is no result yet. SCENE may be the folder.")
      .excludes("--force");
  options
      .flag("--estimate-error", arguments.estimate_error,
            "Then repeat the run at rtol / 10 (or half the fixed step) and print the difference.")
      .excludes("--resume");
}

int run_scene(const RunArguments& arguments) { return Run(arguments).execute(); }

const CommandRegistration kRegistration({.order = 10,
                                         .name = "run",
                                         .sentence = "Run a scene: frames for ParaView, energies, steps, a summary.",
                                         .examples = R"(
  orthodyn run configs/scenes/cantilever.yaml --set integrator.rtol=1e-5 --out out/fine
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume)"},
                                        declare, run_scene);

}  // namespace

}  // namespace orthodyn
