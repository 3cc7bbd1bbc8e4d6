// `orthodyn run`: computes a scene and writes its results.
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
#include "tools/orthodyn/on_ranks.h"
#include "tools/orthodyn/run_summary.h"
#include "tools/orthodyn/run_terminal.h"
#include "tools/orthodyn/scene_options.h"
#include "tools/orthodyn/slurm.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct RunArguments : SceneArguments {
  std::optional<std::string> out;
  bool quiet = false, force = false, resume = false, estimate_error = false, yes = false;
  std::optional<std::string> slurm;  // "print" or "submit"
  std::optional<int> ranks;          // number of ranks to start, now or in the job
};

// `run DIR --resume` runs DIR/scene.yaml with DIR as the result folder.
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

void require_options_for_ranks(const RunArguments& arguments, const Ranks* ranks = nullptr) {
  if (ranks && arguments.ranks)
    throw ConfigError(
        fmt::format("--ranks: mpirun has already started {} ranks; use either mpirun or --ranks", ranks->size()));
  if (arguments.estimate_error)
    throw ConfigError(
        "--estimate-error: not available on several ranks; run again with a smaller rtol or step and compare the "
        "results");
}

// `ranks`: the ranks that run the scene, of which this process is one; null without MPI.
int run_scene_on(const Ranks* ranks, const RunArguments& arguments) {
  const bool prints = !ranks || ranks->is_first();
  const auto simulation = Simulation::from_file(arguments.scene, arguments.changes);
  if (ranks) require_options_for_ranks(arguments, ranks);
  RunListener nobody;
  std::optional<RunTerminal> terminal;
  if (prints) terminal.emplace(arguments.quiet);
  const RunResult result = simulation.run({.folder = folder_for(arguments),
                                           .force = arguments.force,
                                           .resume = arguments.resume,
                                           .estimate_error = arguments.estimate_error,
                                           .allow_large_output = arguments.yes,
                                           .ranks = ranks},
                                          interrupted(), terminal ? *terminal : nobody);
  if (result.only_this_rank_failed && prints) ranks->abort(exit_code(result));  // the message has been printed
  if (result.only_this_rank_failed) end_all_ranks(*ranks, result.outcome.message);
  if (result.was_complete && !arguments.quiet && prints)
    fmt::print("{} is complete at t = {:.6g} s: nothing to do\n", result.folder.string(), result.outcome.last.t);
  if (result.motion && result.motion->error) print_estimate(result);
  return exit_code(result);
}

// The options of this command line to pass on to the job or the ranks, except folders, --quiet and --resume.
std::vector<std::string> options_of(const RunArguments& arguments) {
  std::vector<std::string> options;
  for (const auto& change : arguments.changes.set) options.insert(options.end(), {"--set", change});
  if (arguments.changes.integrator) options.insert(options.end(), {"--integrator", *arguments.changes.integrator});
  if (arguments.force) options.push_back("--force");
  if (arguments.yes) options.push_back("--yes");
  if (arguments.estimate_error) options.push_back("--estimate-error");
  return options;
}

// Validates first, so that input errors appear now and not when the job starts.
int write_job(const RunArguments& arguments) {
  Config config = read_scene_file(arguments.scene, arguments.changes).resolving();
  Scene scene = read_scene(config);
  const int ranks = arguments.ranks.value_or(1);
  if (ranks > 1) {
    require_options_for_ranks(arguments);
    adapt_to_ranks(config, scene);
  }
  fs::path folder = fs::absolute(folder_for(arguments)).lexically_normal();
  if (folder.filename().empty()) folder = folder.parent_path();  // "out/fine/"
  fs::create_directories(folder.parent_path());                  // for the log of the job
  const bool can_resume = scene.checkpoint.has_value() && !arguments.force && !arguments.estimate_error;
  const RunJob job{.program = this_program(),
                   .scene = fs::absolute(arguments.scene),
                   .folder = folder,
                   .options = options_of(arguments),
                   .ranks = ranks,
                   .threads = scene.threads.value_or(1),
                   .resumes = can_resume || arguments.resume};
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
  exec_on_ranks(*arguments.ranks, words);
}

int run_scene(const RunArguments& given) {
  const RunArguments arguments = with_scene_of_folder(given);
  if (arguments.slurm && is_one_of_several_ranks())
    throw ConfigError("--slurm: the job starts mpirun itself; call this command without mpirun");
  if (arguments.slurm) return write_job(arguments);
  if (arguments.ranks.value_or(1) > 1 && !is_one_of_several_ranks()) run_on_ranks(arguments);
  catch_interrupts();
  return run_on_world_ranks([&](const Ranks* ranks) { return run_scene_on(ranks, arguments); });
}

void declare(RunArguments& arguments, CommandOptions& options) {
  declare_scene(arguments, options);
  options.value("--out", arguments.out, "Folder for the results; default out/<scene>.").type("DIR");
  options.flag("--quiet", arguments.quiet, "Print warnings and errors only.");
  options.flag("--force", arguments.force, "Replace an earlier result in the folder.");
  options.flag("--yes", arguments.yes, "Allow a million frames, table rows or load steps and more.");
  options
      .flag("--resume", arguments.resume,
            "Continue from the checkpoint in the folder, or start if there is none. SCENE may be the result folder.")
      .excludes("--force");
  options
      .flag("--estimate-error", arguments.estimate_error,
            "Estimate the time integration error: repeat the run at rtol / 10 (or half the fixed step) and compare.")
      .excludes("--resume");
  options.value("--slurm", arguments.slurm, "Print the script of a SLURM job that computes the scene, or submit it.")
      .choice({"print", "submit"});
  options
      .value("--ranks", arguments.ranks,
             "Number of MPI ranks that compute the scene together; starts mpirun. Default 1. Use for large meshes.")
      .range(1, 1'000'000);
}

const CommandRegistration run_command(
    {.order = 10,
     .name = "run",
     .sentence = "Run a scene: writes frames for ParaView, energies and steps; prints a summary.",
     .examples = R"(
  orthodyn run configs/scenes/cantilever.yaml --set integrator.rtol=1e-5 --out out/fine
  orthodyn run configs/scenes/laminate.yaml --set checkpoint={} --resume
  orthodyn run configs/scenes/cantilever.yaml --ranks 2
  orthodyn run mine.yaml --slurm --ranks 64 > job.sh; sbatch job.sh)",
     .on_ranks = true},
    declare, run_scene);

}  // namespace

}  // namespace orthodyn
