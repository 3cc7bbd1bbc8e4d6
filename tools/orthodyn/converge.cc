// `orthodyn converge`: a scene on successively refined meshes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "lib/core/spelling.h"
#include "lib/scene/mesh_materials.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/study/converge/convergence_table.h"
#include "lib/study/inputs/labels.h"
#include "lib/study/jobs/json_values.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/study_command.h"
#include "tools/orthodyn/study_messages.h"

namespace orthodyn::study::converge {

namespace fs = std::filesystem;

namespace {

struct ConvergeArguments : StudyArguments {
  std::vector<std::string> set, quantities;
  int levels = 3, modes = 0;
  double seconds = 600;
  std::string orders;  // empty: those that the elements have
};

std::vector<int> parse_orders(const std::string& text) {
  if (text == "1") return {1};
  if (text == "2") return {2};
  if (text == "1,2" || text == "2,1") return {1, 2};
  throw ConfigError(fmt::format("--order: expected 1, 2 or 1,2, found '{}'", text));
}

// Linear and quadratic tetrahedra are compared; of hexahedra and wedges only quadratic ones, because linear ones are
// far too stiff in bending, and layups and 27-node hexahedra exclude them.
std::vector<int> orders_of(const ConvergeArguments& arguments) {
  if (!arguments.orders.empty()) return parse_orders(arguments.orders);
  const Scene scene = read_scene(read_scene_file(arguments.file, {.set = arguments.set}));
  return load_mesh(scene).mesh.has_tets_only() ? std::vector{1, 2} : std::vector{2};
}

Convergence convergence_from(const ConvergeArguments& arguments) {
  if (!(arguments.seconds > 0)) throw ConfigError("--seconds: must be positive");
  for (const auto& assignment : arguments.set)
    if (assignment.starts_with("mesh.order="))
      throw ConfigError("--set " + assignment + ": the order is varied by this command; use --order");
  return {.file = arguments.file,
          .set = arguments.set,
          .levels = arguments.levels,
          .orders = orders_of(arguments),
          .quantities = arguments.quantities,
          .modes = arguments.modes,
          .limits = {.seconds = arguments.seconds},
          .ranks = arguments.ranks};
}

std::string outcome_of(const EvaluationResult& result) {
  if (result.failure) return "failed: " + result.failure->reason;
  std::vector<std::string> words;
  for (const auto& [name, value] : result.metrics) words.push_back(name + " " + known_value(result, name, value));
  return join(words);
}

void require_meshes_to_run_on_ranks(const ConvergeArguments& arguments) {
  if (arguments.ranks == 1) return;
  if (arguments.modes > 0)
    throw ConfigError("--modes: natural frequencies are computed by one process only; remove --modes or --ranks");
  Config config = read_scene_file(arguments.file, {.set = arguments.set}).resolving();
  Scene scene = read_scene(config);
  adapt_to_ranks(config, scene);
}

int converge(const ConvergeArguments& arguments) {
  require_ranks(arguments);
  use_one_thread_each();
  require_meshes_to_run_on_ranks(arguments);
  const Convergence wanted = convergence_from(arguments);
  const Design design = design_of(wanted);
  const fs::path folder = folder_for(arguments, "out/convergence", stem(arguments.file));
  InputWarningPrinter().print(read_scene_file(wanted.file, {.set = wanted.set}));
  const StudyFolder place(folder, "convergence", arguments.file);
  PointJobs factory(input_of(wanted, design), wanted.limits, folder, arguments.ranks);
  std::vector<Job> jobs;
  for (const Level& level : design.levels) jobs.push_back(factory.job(level.scene));

  Results results;
  const auto write_table = [&] {
    Json table = convergence_json(wanted, design, jobs, results);
    write_file(folder / "convergence.json", {to_text(table, 1)});
    write_file(folder / "convergence.csv", {convergence_csv(table)});
    return table;
  };
  ProgressReporter reporter(arguments.quiet);
  FailureSummary failures;
  const std::size_t kept = arguments.retry ? 0 : number_at_limits(jobs);
  const JobEvents events{.ends = [&](std::size_t i, const Json& result, bool cached) {
    const EvaluationResult& evaluated = results[jobs[i].folder] = evaluation_from(result);
    reporter.report(jobs.size(), jobs[i].title, outcome_of(evaluated), cached);
    write_table();
  }};
  const bool complete = job_queue(arguments, worker_count(arguments)).run(jobs, events);
  for (const Job& job : jobs)
    if (const auto found = results.find(job.folder); found != results.end())
      failures.add(job.title, found->second.failure);
  const Json table = write_table();
  if (!complete) print_interrupted("meshes", folder);
  if (!arguments.quiet) fmt::print("{}\ntable   {}\n", convergence_text(table), (folder / "convergence.csv").string());
  show_report(folder, arguments);
  failures.print();
  print_kept_failures(kept);
  return complete ? failures.exit_code() : 130;
}

void declare(ConvergeArguments& arguments, CommandOptions& options) {
  declare_study(arguments, options, {"scene", "A scene in YAML.", "convergence", "convergence", "meshes"});
  declare_jobs(arguments, options, "meshes");
  declare_ranks(arguments, options, "mesh");
  options.repeated("--set", arguments.set, "Change a value of the scene by its path, e.g. mesh.cells=[10,1,1].")
      .type("PATH=VALUE");
  options
      .value("--levels", arguments.levels,
             "Number of meshes: the scene's own, then each twice as fine as the one before.")
      .range(2, 8)
      .show_default();
  options.value("--order", arguments.orders,
                "Element orders to compute: 1 (linear), 2 (quadratic) or 1,2. Default: 1,2; 2 for meshes with "
                "hexahedra or wedges.");
  options
      .repeated("--quantity", arguments.quantities,
                "Quantity to compute, e.g. tip.displacement.z, \"max of tip.displacement.z\", energy.elastic. Default: "
                "the quantities under 'expect' in the scene, else the displacements of its probes.")
      .type("NAME");
  options.value("--modes", arguments.modes, "Compute this many of the lowest natural frequencies instead of a motion.")
      .range(0, 100);
  options.value("--seconds", arguments.seconds, "Time limit of each mesh, in s of wall time.").show_default();
}

const CommandRegistration converge_command(
    {.order = 55,
     .name = "converge",
     .sentence = "Refine the mesh of a scene: errors in space, orders of convergence, extrapolated limits, run times. "
                 "Run it again to continue.",
     .examples = R"(
  orthodyn converge configs/scenes/shelf.yaml --set mesh.cells=[8,2,1] --levels 3
  orthodyn converge configs/scenes/cantilever.yaml --quantity "max of tip.displacement.z" --order 2
  orthodyn converge mine.yaml --modes 3        natural frequencies)"},
    declare, converge);

}  // namespace

}  // namespace orthodyn::study::converge
