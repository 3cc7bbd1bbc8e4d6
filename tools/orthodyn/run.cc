// `orthodyn run`: one scene from start to end, with everything that it writes.
#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "lib/core/file_kind.h"
#include "lib/linear/mpi_world.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/simulation/simulation.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/mpirun.h"
#include "tools/orthodyn/notice.h"
#include "tools/orthodyn/on_ranks.h"
#include "tools/orthodyn/run_job.h"
#include "tools/orthodyn/run_summary.h"
#include "tools/orthodyn/scene_options.h"
#include "tools/orthodyn/slow_set_up.h"
#include "tools/orthodyn/slurm.h"
#include "tools/orthodyn/terminal_progress.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct RunArguments : SceneArguments {
  std::optional<std::string> out;
  bool quiet = false, force = false, resume = false, estimate_error = false, yes = false;
  std::optional<std::string> slurm;  // "print" or "submit"
  std::optional<int> ranks;          // to start, or of the job
};

// Prints what a run reports.
class Terminal : public RunListener {
 public:
  explicit Terminal(bool quiet) : quiet_(quiet) {
    if (!quiet) slow_set_up_.emplace();
  }

  void on_warning(const std::string& text) override { print_notice("warning: " + text + "\n"); }

  void on_notice(const std::string& text) override {
    if (!quiet_) print_notice(text + "\n");
  }

  std::unique_ptr<Observer> on_begin(const Setup& setup) override {
    slow_set_up_.reset();
    if (quiet_ || setup.scene.is_static()) return nullptr;
    return std::make_unique<TerminalProgress>(setup.scene.time.start, setup.scene.time.end, stderr);
  }

  // A summary that nobody reads is no reason to go without the estimate of the error: main.cc looks at the output.
  void on_result(const RunResult& result) override {
    try {
      print_result(result, quiet_);
    } catch (const std::system_error&) {
    }
  }

 private:
  bool quiet_;
  std::optional<SlowSetUp> slow_set_up_;  // until the run begins
};

// `run DIR --resume` is the scene in that folder.
RunArguments with_scene_of_folder(RunArguments arguments) {
  if (!arguments.resume || !is_folder(arguments.scene)) return arguments;
  if (!arguments.out) arguments.out = arguments.scene;
  arguments.scene = (fs::path(arguments.scene) / "scene.yaml").string();
  return arguments;
}

fs::path folder_for(const RunArguments& arguments) {
  return arguments.out ? fs::path(*arguments.out) : fs::path("out") / fs::path(arguments.scene).stem();
}

int exit_code(const RunResult& result) {
  if (result.outcome.status == Outcome::Status::failed) return 3;
  if (result.outcome.status == Outcome::Status::interrupted) return 130;
  const bool estimated = !result.motion || !result.motion->error || result.motion->error->completed;
  return estimated ? 0 : interrupted() ? 130 : 3;
}

void refuse_on_ranks(const RunArguments& arguments, const Ranks* ranks = nullptr) {
  if (ranks && arguments.ranks)
    throw ConfigError(fmt::format("--ranks starts mpirun, which has already started {} ranks here; use one of the two",
                                  ranks->size()));
  if (arguments.estimate_error)
    throw ConfigError(
        "--estimate-error repeats the run, which it does not on several ranks; run again with a smaller "
        "rtol or step, and compare");
}

// `ranks`: of which this process is one; null for one that is alone.
int run_scene_on(const Ranks* ranks, const RunArguments& arguments) {
  const bool tells = !ranks || ranks->is_first();
  const auto simulation = Simulation::from_file(arguments.scene, arguments.changes);
  if (ranks) refuse_on_ranks(arguments, ranks);
  RunListener nobody;
  std::optional<Terminal> terminal;
  if (tells) terminal.emplace(arguments.quiet);
  const RunResult result = simulation.run({.folder = folder_for(arguments),
                                           .force = arguments.force,
                                           .resume = arguments.resume,
                                           .estimate_error = arguments.estimate_error,
                                           .any_output_size = arguments.yes,
                                           .ranks = ranks},
                                          interrupted(), terminal ? *terminal : nobody);
  if (result.failed_alone && tells) ranks->abort(exit_code(result));  // the message has been printed
  if (result.failed_alone) end_all_ranks(*ranks, result.outcome.message);
  if (result.was_complete && !arguments.quiet && tells)
    fmt::print("{} is complete at t = {:.6g} s: nothing to do\n", result.folder.string(), result.outcome.last.t);
  if (result.motion && result.motion->error) print_estimate(result);
  return exit_code(result);
}

// The options of the job's own command.
std::vector<std::string> options_of(const RunArguments& arguments) {
  std::vector<std::string> options;
  for (const auto& change : arguments.changes.set) options.insert(options.end(), {"--set", change});
  if (arguments.changes.integrator) options.insert(options.end(), {"--integrator", *arguments.changes.integrator});
  if (arguments.force) options.push_back("--force");
  if (arguments.yes) options.push_back("--yes");
  if (arguments.estimate_error) options.push_back("--estimate-error");
  return options;
}

// What would end the job as soon as it starts is told now.
int write_job(const RunArguments& arguments) {
  Config config = read_scene_file(arguments.scene, arguments.changes).resolving();
  Scene scene = read_scene(config);
  const int ranks = arguments.ranks.value_or(1);
  if (ranks > 1) {
    refuse_on_ranks(arguments);
    settle_for_ranks(config, scene);
  }
  fs::path folder = fs::absolute(folder_for(arguments)).lexically_normal();
  if (folder.filename().empty()) folder = folder.parent_path();  // "out/fine/"
  fs::create_directories(folder.parent_path());                  // where the job leaves its log
  const bool goes_on = scene.checkpoint.has_value() && !arguments.force && !arguments.estimate_error;
  const RunJob job{.program = this_program(),
                   .scene = fs::absolute(arguments.scene),
                   .folder = folder,
                   .options = options_of(arguments),
                   .ranks = ranks,
                   .threads = scene.threads.value_or(1),
                   .goes_on = goes_on || arguments.resume};
  if (*arguments.slurm == "submit") fmt::print("job     {}\n", submit_script(folder, run_script(job)));
  else fmt::print("{}", run_script(job));
  return 0;
}

[[noreturn]] void run_on_ranks(const RunArguments& arguments) {
  std::vector<std::string> words{"run", arguments.scene};
  for (const auto& option : options_of(arguments)) words.push_back(option);
  if (arguments.out) words.insert(words.end(), {"--out", *arguments.out});
  if (arguments.quiet) words.push_back("--quiet");
  if (arguments.resume) words.push_back("--resume");
  go_on_as_ranks(*arguments.ranks, words);
}

int run_scene(const RunArguments& given) {
  const RunArguments arguments = with_scene_of_folder(given);
  if (arguments.slurm && is_one_of_several_ranks())
    throw ConfigError("--slurm writes one job, which starts mpirun itself: call it without mpirun");
  if (arguments.slurm) return write_job(arguments);
  if (arguments.ranks.value_or(1) > 1 && !is_one_of_several_ranks()) run_on_ranks(arguments);
  catch_interrupts();
  return on_world_ranks([&](const Ranks* ranks) { return run_scene_on(ranks, arguments); });
}

void declare(RunArguments& arguments, CommandOptions& options) {
  declare_scene(arguments, options);
  options.value("--out", arguments.out, "Folder for the results; default out/<scene>.").type("DIR");
  options.flag("--quiet", arguments.quiet, "No progress and no summary.");
  options.flag("--force", arguments.force, "Replace an earlier result in the folder.");
  options.flag("--yes", arguments.yes, "Also for a million frames, rows or load steps and more.");
  options
      .flag("--resume", arguments.resume,
            "Continue from the checkpoint in the folder, or start if there is no result yet. SCENE may be the folder.")
      .excludes("--force");
  options
      .flag("--estimate-error", arguments.estimate_error,
            "Then repeat the run at rtol / 10 (or half the fixed step) and print the difference.")
      .excludes("--resume");
  options.value("--slurm", arguments.slurm, "The run as a job of SLURM: print its script, or submit it.")
      .choice({"print", "submit"});
  options
      .value("--ranks", arguments.ranks, "Processes that compute the scene together, started by mpirun; default one.")
      .range(1, 1'000'000);
}

const CommandRegistration run_command({.order = 10,
                                       .name = "run",
                                       .sentence = "Run a scene: frames for ParaView, energies, steps, a summary.",
                                       .examples = R"(
  orthodyn run configs/scenes/cantilever.yaml --set integrator.rtol=1e-5 --out out/fine
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume
  orthodyn run configs/scenes/cantilever.yaml --ranks 2
  orthodyn run mine.yaml --slurm --ranks 64 > job.sh; sbatch job.sh)",
                                       .on_ranks = true},
                                      declare, run_scene);

}  // namespace

}  // namespace orthodyn
